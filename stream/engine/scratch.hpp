#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "io/file/descriptor.hpp"
#include "stream/engine/aligned_bytes.hpp"
#include "stream/engine/block_memory.hpp"
#include "stream/engine/budget.hpp"
#include "stream/engine/transfer_queue.hpp"

namespace atlasgauge {

/// Where everything that does not fit in memory goes: one store of equal blocks.
///
/// The first blocks live in memory (the resident pool), the others in one file without a name, so
/// nothing is left behind however the run ends. Freed blocks are used again, resident ones first:
/// stages that free their input as they read it keep the file small, and a model that fits in the
/// pool never touches the disk. Stages are written as if every block were on disk.
///
/// The file is opened for direct I/O where the file system allows: pages that pass through the page
/// cache cost several times more CPU. Where the file system has no files without a name, it has one
/// between two system calls: a signal just then would leave an empty file.
/// Whole blocks may be written behind and read ahead of the stage that computes; without queued
/// blocks that is done at once.
/// Thread-safe; distinct blocks may be read and written at the same time.
class Scratch {
 public:
  using BlockId = std::uint32_t;
  static constexpr std::size_t kAlignment = AlignedBytes::kAlignment;

  struct Options {
    std::string directory;
    std::size_t block_bytes = 256 << 10;  ///< multiple of kAlignment
    std::uint64_t resident_bytes = 0;     ///< size of the resident pool; reserved from the budget
    std::size_t queued_blocks = 0;        ///< for transfers under way; reserved from the budget
  };

  Scratch(const Options& options, MemoryBudget& budget);
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::size_t block_bytes() const { return block_bytes_; }

  /// Memory for one block.
  BlockBytes lend() { return memory_.lend(); }

  BlockId allocate();
  void free(BlockId block) noexcept;

  /// Address of a resident block; null for a block on disk.
  std::byte* resident(BlockId block) const;
  /// Writes the first `bytes` of a block on disk; `from` is aligned, and may be read up to the next
  /// multiple of kAlignment.
  void write(BlockId block, const std::byte* from, std::size_t bytes);
  /// Reads `bytes` from `offset` of a block on disk. `to` and `offset` are aligned, `to` has room
  /// up to the next multiple of kAlignment.
  void read(BlockId block, std::size_t offset, std::byte* to, std::size_t bytes) const;

  /// Writes a block some time before it is read. `memory` has another block's worth afterwards.
  void write_behind(BlockId block, BlockBytes& memory, std::size_t bytes);
  /// Begins to read a block that will be loaded soon; a resident one needs no reading.
  void read_ahead(BlockId block, std::size_t bytes);
  /// Reads the first `bytes` of a block on disk, or takes what was read ahead.
  void load(BlockId block, BlockBytes& memory, std::size_t bytes);

  /// What blocks can hold in all, those in use included: the pool, the file, and the free space of
  /// its file system; the largest number if that cannot be told.
  std::uint64_t room_bytes() const;

  /// Bytes handed in for writing, and asked for, so far.
  std::uint64_t written_bytes() const { return written_bytes_; }
  std::uint64_t read_bytes() const { return read_bytes_; }
  /// Largest number of bytes that blocks, resident or not, held at one time.
  std::uint64_t peak_bytes() const;
  /// Blocks handed out that did not fit in the pool, times block size.
  std::uint64_t spilled_bytes() const;

 private:
  std::uint64_t file_offset(BlockId block) const;
  void open_file();
  void start_queue();
  void write_now(BlockId block, const std::byte* from, std::size_t bytes);
  void read_now(BlockId block, std::size_t offset, std::byte* to, std::size_t bytes) const;
  void make_room_for_freed_blocks();
  template <class Transfer>
  void transfer_all(std::size_t bytes, const char* what, Transfer transfer) const;
  void leave_direct_io() const;

  const std::string directory_;
  const std::size_t block_bytes_;
  const std::uint32_t resident_blocks_;
  const std::size_t queued_blocks_;
  Reservation pool_reservation_, queue_reservation_;
  AlignedBytes pool_;
  BlockMemory memory_;
  Descriptor file_;

  mutable std::mutex mutex_;
  std::vector<BlockId> free_resident_;
  std::vector<BlockId> free_on_disk_;
  BlockId next_resident_ = 0;
  BlockId next_on_disk_ = 0;
  std::uint64_t live_blocks_ = 0;
  std::uint64_t peak_blocks_ = 0;
  std::uint64_t spilled_blocks_ = 0;
  std::atomic<std::uint64_t> written_bytes_ = 0;
  mutable std::atomic<std::uint64_t> read_bytes_ = 0;

  std::atomic<TransferQueue*> queue_{nullptr};  ///< once there is a file
  std::unique_ptr<TransferQueue> owned_queue_;
};

/// Memory for one block, borrowed when first asked for.
class BlockBuffer {
 public:
  BlockBytes& bytes(Scratch& scratch) {
    if (!bytes_) bytes_ = scratch.lend();
    return bytes_;
  }
  std::byte* data(Scratch& scratch) { return bytes(scratch).data(); }
  void release() { bytes_.release(); }

 private:
  BlockBytes bytes_;
};

}  // namespace atlasgauge
