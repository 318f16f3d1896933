#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "stream/engine/spill.hpp"

namespace atlasgauge {

/// Single records of a spill, for few of them: each may load a block. The spill must live as long.
template <class T>
class SpillLookup {
 public:
  explicit SpillLookup(const Spill<T>& spill) : spill_(spill) {}

  T at(std::uint64_t index) {
    const auto block = static_cast<std::size_t>(index / spill_.records_per_block());
    if (block != loaded_) records_ = spill_.load(block, buffer_);
    loaded_ = block;
    return records_[static_cast<std::size_t>(index % spill_.records_per_block())];
  }

 private:
  const Spill<T>& spill_;
  BlockBuffer buffer_;
  std::size_t loaded_ = std::numeric_limits<std::size_t>::max();
  std::span<const T> records_;
};

}  // namespace atlasgauge
