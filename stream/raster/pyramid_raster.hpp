#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "stream/mesh/triangle.hpp"
#include "stream/raster/box_filter.hpp"
#include "stream/raster/raster.hpp"
#include "stream/raster/region_triangle.hpp"
#include "stream/raster/tile_pyramid.hpp"

namespace atlasgauge {

/// Draws triangles on all levels of pyramids, for one thread.
class PyramidRaster {
 public:
  explicit PyramidRaster(std::unique_ptr<Raster> raster);

  /// Into the tiles of a slot: all triangles into those of `region`, and those that are first
  /// copies into those of `whole`, too. Returns how many were first copies.
  std::uint64_t draw(std::span<const RegionTriangle> triangles, const SlotFrame& frame,
                     TilePyramid& region, TilePyramid& whole);

  const RasterTally& tally() const { return raster_->tally(); }

 private:
  std::uint64_t remove_further_copies(std::span<const RegionTriangle> batch);
  void draw_filtered(std::span<const RegionTriangle> batch, const SlotFrame& frame,
                     LevelTile& tile);

  std::unique_ptr<Raster> raster_;
  BoxFilter filter_;
  std::vector<SnappedTriangle> snapped_;
};

}  // namespace atlasgauge
