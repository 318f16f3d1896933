#include "stream/engine/block_memory.hpp"

#include <algorithm>

namespace atlasgauge {

void BlockBytes::release() noexcept {
  if (data_ == nullptr) return;
  owner_->take_back(data_);
  data_ = nullptr;
}

BlockMemory::BlockMemory(std::size_t block_bytes)
    : block_bytes_(AlignedBytes::rounded_up(block_bytes)),
      blocks_per_slab_(block_bytes_ < kSmallestShared
                           ? 1
                           : std::max<std::size_t>(1, AlignedBytes::kHugePage / block_bytes_)) {}

BlockBytes BlockMemory::lend() {
  const std::lock_guard lock(mutex_);
  Slab& slab = slab_with_room();
  std::byte* const block = slab.free.back();
  slab.free.pop_back();
  return {*this, block};
}

std::size_t BlockMemory::held_bytes() const {
  const std::lock_guard lock(mutex_);
  const auto held = std::count_if(slabs_.begin(), slabs_.end(),
                                  [](const Slab& slab) { return bool(slab.memory); });
  return static_cast<std::size_t>(held) * blocks_per_slab_ * block_bytes_;
}

BlockMemory::Slab& BlockMemory::slab_with_room() {
  const auto with_room = std::find_if(slabs_.begin(), slabs_.end(),
                                      [](const Slab& slab) { return !slab.free.empty(); });
  if (with_room != slabs_.end()) return *with_room;
  const auto unused =
      std::find_if(slabs_.begin(), slabs_.end(), [](const Slab& slab) { return !slab.memory; });
  Slab& slab = unused != slabs_.end() ? *unused : slabs_.emplace_back();
  slab.free.reserve(blocks_per_slab_);
  slab.memory = AlignedBytes(blocks_per_slab_ * block_bytes_, AlignedBytes::Pages::kHuge);
  for (std::size_t i = blocks_per_slab_; i > 0; --i) {
    slab.free.push_back(slab.memory.data() + (i - 1) * block_bytes_);
  }
  return slab;
}

void BlockMemory::take_back(std::byte* block) noexcept {
  const std::lock_guard lock(mutex_);
  const auto slab = std::find_if(slabs_.begin(), slabs_.end(), [&](const Slab& s) {
    return s.memory && s.memory.data() <= block &&
           block < s.memory.data() + blocks_per_slab_ * block_bytes_;
  });
  slab->free.push_back(block);
  if (is_empty(*slab)) drop_if_many_are_empty(*slab);
}

void BlockMemory::drop_if_many_are_empty(Slab& slab) {
  const auto empty = std::count_if(slabs_.begin(), slabs_.end(),
                                   [&](const Slab& s) { return s.memory && is_empty(s); });
  const std::size_t empty_blocks = static_cast<std::size_t>(empty) * blocks_per_slab_;
  if (empty == 1 || empty_blocks <= kEmptyBlocksKept) return;
  slab.free.clear();
  slab.memory = AlignedBytes();
}

}  // namespace atlasgauge
