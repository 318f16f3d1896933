#include "stream/raster/texel_counts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

// All that depends on the 3 x 3 texels around one follows from three extremes of their charts, with
// charts numbered from 1 and 0 for an uncovered texel: the highest is 0 where nothing is covered;
// the lowest is 0 where something is not; and the highest differs from the lowest of the covered
// ones where two charts meet. Extremes of a square are extremes of columns, then of rows.
//
// Most texels lie amid one chart or amid none. Rows are cut into runs; where a run and its
// neighbours in all three rows have one value, the run is counted at once.

namespace atlasgauge {
namespace {

/// Charts fit in 31 bits: signed comparison is the one that every vector unit has.
using Chart31 = std::int32_t;
constexpr Chart31 kNoChart = std::numeric_limits<Chart31>::max();

Chart31 max3(Chart31 a, Chart31 b, Chart31 c) {
  return std::max(std::max(a, b), c);
}
Chart31 min3(Chart31 a, Chart31 b, Chart31 c) {
  return std::min(std::min(a, b), c);
}
Chart31 covered_or_none(Chart31 chart) {
  return chart == 0 ? kNoChart : chart;
}

constexpr std::size_t kRun = 16;  // texels
constexpr std::uint32_t kMixed = ~std::uint32_t{0};

/// The value that all words have, or kMixed, which is no chart and no count.
std::uint32_t common_value(const std::uint32_t* words, std::size_t count) {
  std::uint32_t differing = 0;
  for (std::size_t i = 0; i < count; ++i) differing |= words[i] ^ words[0];
  return differing == 0 ? words[0] : kMixed;
}

/// The columns of a run of texels and of one neighbour on each side.
struct Columns {
  Chart31 highest[kRun + 2], lowest[kRun + 2], lowest_covered[kRun + 2];

  /// `row` is that of the middle, from the left neighbour on.
  Columns(const std::uint32_t* row, std::size_t stride, std::size_t columns) {
    const std::uint32_t* const below = row - stride;
    const std::uint32_t* const above = row + stride;
    for (std::size_t i = 0; i < columns; ++i) {
      const auto a = static_cast<Chart31>(below[i]);
      const auto b = static_cast<Chart31>(row[i]);
      const auto c = static_cast<Chart31>(above[i]);
      highest[i] = max3(a, b, c);
      lowest[i] = min3(a, b, c);
      lowest_covered[i] = min3(covered_or_none(a), covered_or_none(b), covered_or_none(c));
    }
  }
};

void count_mixed_run(const std::uint32_t* row, std::size_t stride, std::size_t length,
                     TexelCounts& counts) {
  const Columns columns(row - 1, stride, length + 2);
  std::uint32_t bilinear = 0, boundary = 0, clashes = 0;
  for (std::size_t i = 0; i < length; ++i) {
    const auto of_square = [i](auto extreme, const Chart31* of_columns) {
      return extreme(of_columns[i], of_columns[i + 1], of_columns[i + 2]);
    };
    const Chart31 highest = of_square(max3, columns.highest);
    const bool covered = row[i] != 0;
    bilinear += highest != 0;
    boundary += covered & (of_square(min3, columns.lowest) == 0);
    clashes += covered & (of_square(min3, columns.lowest_covered) != highest);
  }
  counts.bilinear += bilinear;
  counts.boundary += boundary;
  counts.clashes += clashes;
}

/// Adds `texels` texels of one word of TexelTile::counts().
void count_triangles(std::uint32_t word, std::uint64_t texels, TexelCounts& counts) {
  const std::uint32_t n = word & ~TexelTile::kSeveralCharts;
  if (n == 0) return;
  counts.covered += texels;
  counts.drawn += n * texels;
  if (n == 1) return;
  counts.overwritten += texels;
  counts.lost += (n - 1) * texels;
  if (word != n) counts.overlaps_between += texels;
}

void count_triangles(const std::uint32_t* words, std::size_t length, TexelCounts& counts) {
  const std::uint32_t common = common_value(words, length);
  if (common != kMixed) return count_triangles(common, length, counts);
  for (std::size_t i = 0; i < length; ++i) count_triangles(words[i], 1, counts);
}

/// The common values of the runs of one row, neighbours included.
class RunValues {
 public:
  explicit RunValues(std::size_t width) : values_((width + kRun - 1) / kRun) {}
  void take(const std::uint32_t* row, std::size_t width) {
    for (std::size_t run = 0; run < values_.size(); ++run) {
      const std::size_t begin = run * kRun;
      values_[run] = common_value(row + begin, std::min(kRun, width - begin) + 2);
    }
  }
  std::uint32_t operator[](std::size_t run) const { return values_[run]; }

 private:
  std::vector<std::uint32_t> values_;
};

}  // namespace

TexelCounts count_texels(const TexelTile& tile) {
  TexelCounts counts;
  const std::size_t stride = tile.stride();
  const std::size_t width = stride - 2;
  const auto rows = static_cast<std::size_t>(tile.rect().height());
  RunValues below(width), here(width), above(width);
  here.take(tile.charts(), width);
  above.take(tile.charts() + stride, width);
  for (std::size_t y = 1; y <= rows; ++y) {
    std::swap(below, here);
    std::swap(here, above);
    above.take(tile.charts() + (y + 1) * stride, width);
    for (std::size_t run = 0, begin = 0; begin < width; ++run, begin += kRun) {
      const std::size_t length = std::min(kRun, width - begin);
      const std::size_t first = y * stride + 1 + begin;
      const bool uniform =
          here[run] != kMixed && below[run] == here[run] && here[run] == above[run];
      if (!uniform) {
        count_mixed_run(tile.charts() + first, stride, length, counts);
      } else if (here[run] != 0) {
        counts.bilinear += length;
      }
      if (here[run] != 0) count_triangles(tile.counts() + first, length, counts);
    }
  }
  return counts;
}

}  // namespace atlasgauge
