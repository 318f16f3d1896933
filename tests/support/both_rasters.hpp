#pragma once

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "io/error.hpp"
#include "stream/raster/osmesa_raster.hpp"
#include "stream/raster/scalar_raster.hpp"

namespace atlasgauge {

/// Draws with both rasters and compares every texel of the tile and its halo. Throws
/// Error(kInternal) where they differ.
class BothRasters : public Raster {
 public:
  void draw(std::span<const SnappedTriangle> triangles, TexelTile& tile) override {
    TexelTile other = tile;
    scalar_.draw(triangles, tile);
    osmesa_->draw(triangles, other);
    tally_ = osmesa_->tally();
    const std::size_t texels = tile.stride() * static_cast<std::size_t>(tile.rect().height() + 2);
    if (!std::equal(tile.charts(), tile.charts() + texels, other.charts()) ||
        !std::equal(tile.counts(), tile.counts() + texels, other.counts())) {
      throw Error(ErrorKind::kInternal, "the rasters differ in a tile");
    }
  }
  std::size_t batch_size() const override { return osmesa_->batch_size(); }

 private:
  ScalarRaster scalar_;
  std::unique_ptr<Raster> osmesa_ = make_osmesa_raster();
};

}  // namespace atlasgauge
