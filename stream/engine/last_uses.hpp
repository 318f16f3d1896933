#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "stream/engine/budget.hpp"

namespace atlasgauge {

/// Until when keys are in use: for every range of keys, how many items have passed once the last
/// that names one of them has. Memory is bounded: the ranges widen when keys grow beyond them, so
/// that the answers are upper bounds.
class LastUses {
 public:
  static constexpr std::size_t kMostRanges = std::size_t{1} << 16;

  /// Knows of no key.
  LastUses() = default;
  /// Of no more than `most_ranges`, a power of two from 2 on, and about a 64th of the budget.
  explicit LastUses(MemoryBudget& budget, std::size_t most_ranges = kMostRanges) {
    const std::size_t affordable = std::bit_floor(
        std::max<std::uint64_t>(2, budget.limit_bytes() / (64 * sizeof(std::uint32_t))));
    const std::size_t ranges = std::min(most_ranges, affordable);
    memory_ = budget.reserve(ranges * sizeof(std::uint32_t), "last uses of vertices");
    items_.assign(ranges, 0);
  }

  /// An item names a key; `items` are those before it, and it.
  void note(std::uint32_t key, std::uint32_t items) {
    while (range_of(key) >= items_.size()) widen();
    std::uint32_t& last = items_[range_of(key)];
    last = std::max(last, items);
  }

  bool knows_any() const { return !items_.empty(); }
  std::uint32_t keys_per_range() const { return std::uint32_t{1} << shift_; }
  /// After so many items none names the key; 0 for a key that none named.
  std::uint32_t items_until_unused(std::uint32_t key) const {
    const std::size_t range = range_of(key);
    return range < items_.size() ? items_[range] : 0;
  }
  /// Whether hardly any range ends before most of the items have passed, as with items in random
  /// order.
  bool are_late() const {
    std::uint64_t ranges = 0, sum = 0, most = 0;
    for (const std::uint32_t items : items_) {
      if (items == 0) continue;
      ++ranges;
      sum += items;
      most = std::max<std::uint64_t>(most, items);
    }
    return sum > ranges * (most / 8 * 7);
  }

 private:
  std::size_t range_of(std::uint32_t key) const { return std::uint64_t{key} >> shift_; }

  void widen() {
    const std::size_t half = items_.size() / 2;
    for (std::size_t i = 0; i < half; ++i) items_[i] = std::max(items_[2 * i], items_[2 * i + 1]);
    std::fill(items_.begin() + static_cast<std::ptrdiff_t>(half), items_.end(), 0U);
    ++shift_;
  }

  Reservation memory_;
  std::vector<std::uint32_t> items_;
  unsigned shift_ = 0;
};

}  // namespace atlasgauge
