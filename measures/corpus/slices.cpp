#include "measures/corpus/slices.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <queue>
#include <utility>

namespace atlasgauge {

std::uint64_t usual_slices(std::span<const double> seconds) {
  constexpr double kSecondsPerSlice = 60;
  constexpr double kMostSlices = 1000;
  const double total = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  const double most = std::min(kMostSlices, static_cast<double>(seconds.size()));
  return static_cast<std::uint64_t>(
      std::clamp(std::ceil(total / kSecondsPerSlice), 1.0, std::max(1.0, most)));
}

std::vector<std::uint64_t> balanced_slices(std::span<const double> seconds, std::uint64_t slices) {
  std::vector<std::size_t> longest_first(seconds.size());
  std::iota(longest_first.begin(), longest_first.end(), std::size_t{0});
  std::ranges::stable_sort(longest_first, std::greater(),
                           [&](std::size_t i) { return seconds[i]; });

  using Load = std::pair<double, std::uint64_t>;  // seconds, slice
  std::priority_queue<Load, std::vector<Load>, std::greater<>> loads;
  for (std::uint64_t slice = 0; slice < slices; ++slice) loads.emplace(0.0, slice);
  std::vector<std::uint64_t> slice_of(seconds.size());
  for (const std::size_t i : longest_first) {
    const auto [load, slice] = loads.top();
    loads.pop();
    slice_of[i] = slice;
    loads.emplace(load + seconds[i], slice);
  }
  return slice_of;
}

}  // namespace atlasgauge
