#include "stream/raster/pyramid_raster.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "stream/raster/mip_levels.hpp"

namespace atlasgauge {

PyramidRaster::PyramidRaster(std::unique_ptr<Raster> raster)
    : raster_(std::move(raster)), filter_(raster_->batch_size()) {
  snapped_.reserve(raster_->batch_size());
}

std::uint64_t PyramidRaster::draw(std::span<const RegionTriangle> triangles, const SlotFrame& frame,
                                  TilePyramid& region, TilePyramid& whole) {
  std::uint64_t first_copies = 0;
  while (!triangles.empty()) {
    const auto batch = triangles.first(std::min(triangles.size(), raster_->batch_size()));
    filter_.clear();
    for (const RegionTriangle& triangle : batch) filter_.add(triangle.uv(), frame);
    for (LevelTile& tile : region.tiles()) draw_filtered(batch, frame, tile);
    first_copies += remove_further_copies(batch);
    for (LevelTile& tile : whole.tiles()) draw_filtered(batch, frame, tile);
    triangles = triangles.subspan(batch.size());
  }
  return first_copies;
}

/// From the filter. Returns how many are left.
std::uint64_t PyramidRaster::remove_further_copies(std::span<const RegionTriangle> batch) {
  std::uint64_t left = batch.size();
  for (std::size_t i = 0; i < batch.size(); ++i) {
    if (batch[i].is_first()) continue;
    filter_.remove(i);
    --left;
  }
  return left;
}

void PyramidRaster::draw_filtered(std::span<const RegionTriangle> batch, const SlotFrame& frame,
                                  LevelTile& tile) {
  const SlotFrame level = at_level(frame, tile.size);
  snapped_.clear();
  for (const std::uint32_t i : filter_.choose(tile)) {
    snapped_.push_back(snapped(batch[i].uv(), batch[i].chart(), level));
  }
  raster_->draw(snapped_, tile.tile);
}

}  // namespace atlasgauge
