#pragma once

#include <span>

#include "stream/raster/raster.hpp"

namespace atlasgauge {

/// The default raster, in integers only: small triangles centre by centre against their three
/// half-spaces, others by the rows of texels they cover, so that a large one costs no more than
/// those in the tile.
class ScalarRaster : public Raster {
 public:
  void draw(std::span<const SnappedTriangle> triangles, TexelTile& tile) override;
  std::size_t batch_size() const override { return 256; }
};

}  // namespace atlasgauge
