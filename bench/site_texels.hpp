#pragma once

#include <cstdint>
#include <vector>

namespace atlasgauge {

/// Texels [left, right) × [bottom, top) of a texture, covered once, by one chart.
struct TexelRect {
  std::int64_t left, right, bottom, top;
};

/// SPEC section 4, where no texel is covered twice.
struct TexelCounts {
  std::uint64_t covered = 0;
  std::uint64_t bilinear = 0;
  std::uint64_t boundary = 0;
  std::uint64_t clashes = 0;
};

/// Of rectangles that do not overlap, each of another chart, on a texture of size × size texels.
/// Rows alike are counted once, so the cost is that of the rectangles, not of the texels.
TexelCounts count_texels(const std::vector<TexelRect>& rects, std::int64_t size);

}  // namespace atlasgauge
