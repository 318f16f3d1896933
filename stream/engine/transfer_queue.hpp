#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "stream/engine/block_memory.hpp"

namespace atlasgauge {

/// Transfers of whole blocks that go on while stages compute: writes behind them, reads ahead.
///
/// Half of the slots are for writes, half for reads. A slot holds one block's bytes: of a write
/// from the moment they are handed in until they are on disk, of a read until they are taken. Bytes
/// change hands by swapping memory, never by copying. What two transfers of one block must not do
/// is overtake each other: nothing is read while a write of it is under way, nor written before an
/// earlier write of it has ended (a block may be freed, and handed out again, before that).
///
/// A failed write is thrown at whoever calls next, a failed read at who takes the block.
/// Thread-safe, where every block has one owner at a time. Its threads take no signals, so that
/// these end the program where its main thread lets them.
class TransferQueue {
 public:
  using BlockId = std::uint32_t;
  struct Device {
    std::function<void(BlockId block, const std::byte* from, std::size_t bytes)> write;
    std::function<void(BlockId block, std::byte* to, std::size_t bytes)> read;
  };

  static constexpr std::size_t kThreads = 2;

  /// Throws std::system_error if the system gives no thread.
  TransferQueue(std::size_t slots, BlockMemory& memory, Device device);
  ~TransferQueue();

  /// Takes over the bytes in `memory`, which is other memory of the same size afterwards.
  void write(BlockId block, BlockBytes& memory, std::size_t bytes);
  /// Begins to read the block, if there is room for it. Blocks read long ago, which nobody took,
  /// make room.
  void read_ahead(BlockId block, std::size_t bytes);
  /// Whether the block was read ahead: `memory` then holds it. If not, it may be read now.
  bool take(BlockId block, BlockBytes& memory);
  /// Waits for the end of a write of the block.
  void settle(BlockId block);
  /// The block is not wanted any more.
  void forget(BlockId block) noexcept;

 private:
  enum class State { kFree, kWaiting, kUnderWay, kRead, kFailed };
  struct Slot {
    State state = State::kFree;
    bool forgotten = false;
    BlockId block = 0;
    std::size_t bytes = 0;
    std::uint64_t turn = 0;
    BlockBytes memory;
    std::exception_ptr error;
  };
  using Lock = std::unique_lock<std::mutex>;

  void stop();
  bool is_write(const Slot& slot) const;
  Slot* find(BlockId block);
  Slot* free_slot(std::size_t first, std::size_t end);
  Slot* oldest(State state);
  Slot* stale_read();
  void settle(BlockId block, Lock& lock);
  void enqueue(Slot& slot, BlockId block, std::size_t bytes);
  void run();
  void transfer(Slot& slot, Lock& lock);

  BlockMemory& memory_;
  const Device device_;
  std::mutex mutex_;
  std::condition_variable work_, progress_;
  std::vector<Slot> slots_;  ///< writes in the first half
  std::uint64_t next_turn_ = 0;
  bool stopped_ = false;
  std::exception_ptr error_;
  std::vector<std::jthread> threads_;
};

}  // namespace atlasgauge
