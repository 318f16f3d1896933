#pragma once

#include <cstdint>
#include <vector>

#include "io/mesh_batch.hpp"
#include "stream/mesh/triangle.hpp"
#include "stream/raster/raster.hpp"
#include "stream/raster/texel_tile.hpp"
#include "stream/raster/tile_grid.hpp"

namespace atlasgauge {

/// A triangle on its way to the raster: first in the bin of its slot, then in those of the tiles
/// that it may touch. It carries its UVs, as every level snaps them for itself.
struct BinTriangle {
  std::uint32_t bin;
  std::uint32_t chart;
  TexCoord uv[3];

  std::uint32_t key() const { return bin; }
};
static_assert(sizeof(BinTriangle) == 32);

/// The frame of a slot at one of its mip levels.
inline SlotFrame at_level(SlotFrame frame, const LevelSize& size) {
  frame.width = static_cast<double>(size.width);
  frame.height = static_cast<double>(size.height);
  return frame;
}

/// The same for some levels.
inline std::vector<SlotFrame> at_levels(const SlotFrame& frame,
                                        const std::vector<LevelSize>& sizes) {
  std::vector<SlotFrame> frames;
  frames.reserve(sizes.size());
  for (const LevelSize& size : sizes) frames.push_back(at_level(frame, size));
  return frames;
}

/// Calls use(tile) for every tile of the grid, whose levels have these frames, that the triangle
/// may touch.
template <class Use>
void visit_touched(const BinTriangle& triangle, const std::vector<SlotFrame>& frames,
                   const TileGrid& grid, Use use) {
  for (std::uint32_t level = 0; level < grid.tiled_levels(); ++level) {
    const SlotFrame& frame = frames[level];
    const Texel corner[3] = {frame.texel(triangle.uv[0]), frame.texel(triangle.uv[1]),
                             frame.texel(triangle.uv[2])};
    grid.visit_touched(level, corner, use);
  }
}

/// In 1/256 texel of the level that `frame` is of.
inline SnappedTriangle snapped(const BinTriangle& triangle, const SlotFrame& frame) {
  SnappedTriangle result;
  for (int k = 0; k < 3; ++k) {
    const Texel texel = frame.texel(triangle.uv[k]);
    result.x[k] = snap(texel.x);
    result.y[k] = snap(texel.y);
  }
  result.chart = triangle.chart;
  return result;
}

}  // namespace atlasgauge
