#pragma once

#include <cstddef>
#include <mutex>
#include <utility>
#include <vector>

#include "stream/engine/aligned_bytes.hpp"

namespace atlasgauge {

class BlockMemory;

/// Memory for one block, on loan; gives it back when it dies.
class BlockBytes {
 public:
  BlockBytes() = default;
  BlockBytes(BlockBytes&& other) noexcept
      : owner_(std::exchange(other.owner_, nullptr)), data_(std::exchange(other.data_, nullptr)) {}
  BlockBytes& operator=(BlockBytes&& other) noexcept {
    std::swap(owner_, other.owner_);
    std::swap(data_, other.data_);
    return *this;
  }
  ~BlockBytes() { release(); }

  std::byte* data() const { return data_; }
  explicit operator bool() const { return data_ != nullptr; }
  void release() noexcept;

 private:
  friend class BlockMemory;
  BlockBytes(BlockMemory& owner, std::byte* data) : owner_(&owner), data_(data) {}

  BlockMemory* owner_ = nullptr;
  std::byte* data_ = nullptr;
};

/// Lends memory for blocks. Several blocks lie together in a slab that fills a huge page; tiny ones
/// each have a slab of their own. Loans come from the first slab with room, so that the others can
/// be given back to the system: all that are empty but a few.
/// Thread-safe; loans do not outlive it.
class BlockMemory {
 public:
  explicit BlockMemory(std::size_t block_bytes);

  BlockBytes lend();
  /// Memory held from the system.
  std::size_t held_bytes() const;

 private:
  friend class BlockBytes;
  /// Blocks smaller than this are not worth a part of a huge page.
  static constexpr std::size_t kSmallestShared = 64 << 10;
  static constexpr std::size_t kEmptyBlocksKept = 8;

  struct Slab {
    AlignedBytes memory;
    std::vector<std::byte*> free;
  };
  void take_back(std::byte* block) noexcept;
  Slab& slab_with_room();
  void drop_if_many_are_empty(Slab& slab);
  bool is_empty(const Slab& slab) const { return slab.free.size() == blocks_per_slab_; }

  const std::size_t block_bytes_, blocks_per_slab_;
  mutable std::mutex mutex_;
  std::vector<Slab> slabs_;  ///< one without memory may be filled again
};

}  // namespace atlasgauge
