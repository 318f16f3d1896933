#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "io/mesh_batch.hpp"
#include "stream/mesh/triangle.hpp"
#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {

/// A triangle in the texel grid of one mip level, in 1/256 texel, |coordinate| <= 2^38 (triangles
/// that reach beyond 2^30 texels are not drawn at all, SPEC section 1).
struct SnappedTriangle {
  std::int64_t x[3], y[3];
  std::uint32_t chart;
};

/// Rounds a coordinate in texels to 1/256 texel, half to even, as llrint(texels * 256) does: at
/// 1.5 * 2^52 doubles are the integers. Unlike a call of llrint this can be vectorized.
inline std::int64_t snap(double texels) {
  constexpr double kIntegers = 0x1.8p52;
  return std::bit_cast<std::int64_t>(texels * 256 + kIntegers) -
         std::bit_cast<std::int64_t>(kIntegers);
}

/// In 1/256 texel of the level that `frame` is of.
inline SnappedTriangle snapped(const TexCoord (&uv)[3], std::uint32_t chart,
                               const SlotFrame& frame) {
  SnappedTriangle result;
  for (int k = 0; k < 3; ++k) {
    const Texel texel = frame.texel(uv[k]);
    result.x[k] = snap(texel.x);
    result.y[k] = snap(texel.y);
  }
  result.chart = chart;
  return result;
}

/// The first texel whose centre (at 256 i + 128) is not below a position.
inline std::int64_t first_centre(std::int64_t position) {
  return (position + 127) >> 8;
}

/// Texels of the window whose centres lie in the box around a triangle: left and lower sides belong
/// to it. No others can be covered.
inline TexelRect centres_in_box(const SnappedTriangle& triangle, const TexelRect& window) {
  const auto [low_x, high_x] = std::minmax({triangle.x[0], triangle.x[1], triangle.x[2]});
  const auto [low_y, high_y] = std::minmax({triangle.y[0], triangle.y[1], triangle.y[2]});
  return {std::max(window.x0, first_centre(low_x)), std::max(window.y0, first_centre(low_y)),
          std::min(window.x1, first_centre(high_x)), std::min(window.y1, first_centre(high_y))};
}

/// How many triangles went to which raster; those that touch no texel centre's row and column of
/// the tile go to none.
struct RasterTally {
  std::uint64_t scalar = 0;
  std::uint64_t osmesa = 0;

  void merge(const RasterTally& other) {
    scalar += other.scalar;
    osmesa += other.osmesa;
  }
};

/// Draws triangles into tiles, for one thread: adds one to the count of every texel whose centre a
/// triangle covers, and notes its chart.
///
/// A centre on an edge belongs to the triangle when the edge is a left one, or a horizontal one
/// with the triangle above it (lower v inclusive). Triangles of zero area cover nothing; either
/// orientation counts. All rasters agree on every texel, whatever the tile.
class Raster {
 public:
  virtual ~Raster() = default;
  virtual void draw(std::span<const SnappedTriangle> triangles, TexelTile& tile) = 0;
  /// How many triangles a call should bring, as far as there are so many.
  virtual std::size_t batch_size() const = 0;

  const RasterTally& tally() const { return tally_; }

 protected:
  RasterTally tally_;
};

}  // namespace atlasgauge
