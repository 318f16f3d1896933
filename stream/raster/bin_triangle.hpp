#pragma once

#include <cstdint>
#include <vector>

#include "io/mesh_batch.hpp"
#include "stream/mesh/triangle.hpp"
#include "stream/raster/mip_levels.hpp"
#include "stream/raster/raster.hpp"
#include "stream/raster/texel_tile.hpp"
#include "stream/raster/tile_grid.hpp"

namespace atlasgauge {

/// A triangle on its way to a map: first in the bin of its slot, then in those of the tiles that it
/// may touch. It carries its UVs, as every level snaps them for itself.
struct BinTriangle {
  std::uint32_t bin;
  std::uint32_t chart;
  TexCoord uv[3];

  std::uint32_t key() const { return bin; }
};
static_assert(sizeof(BinTriangle) == 32);

/// The frames of a slot at some of its mip levels.
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
  for (std::uint32_t level = 0; level < grid.level_count(); ++level) {
    const SlotFrame& frame = frames[level];
    const Texel corner[3] = {frame.texel(triangle.uv[0]), frame.texel(triangle.uv[1]),
                             frame.texel(triangle.uv[2])};
    grid.visit_touched(level, corner, use);
  }
}

inline SnappedTriangle snapped(const BinTriangle& triangle, const SlotFrame& frame) {
  return snapped(triangle.uv, triangle.chart, frame);
}

}  // namespace atlasgauge
