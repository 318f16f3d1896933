#include "stream/raster/texel_tile.hpp"

#include <algorithm>

namespace atlasgauge {

void TexelTile::reset(const TexelRect& rect, const LevelSize& level) {
  rect_ = rect;
  window_ = {std::max<std::int64_t>(0, rect.x0 - 1), std::max<std::int64_t>(0, rect.y0 - 1),
             std::min(level.width, rect.x1 + 1), std::min(level.height, rect.y1 + 1)};
  stride_ = static_cast<std::size_t>(rect.width() + 2);
  const std::size_t texels = stride_ * static_cast<std::size_t>(rect.height() + 2) + kPadding;
  charts_.assign(texels, 0);
  counts_.assign(texels, 0);
}

void TexelTile::merge(const TexelTile& other) {
  for (std::size_t at = 0; at < charts_.size(); ++at) {
    const std::uint32_t count = other.counts_[at];
    if (count != 0) {
      cover(at, count & ~kSeveralCharts, other.charts_[at], (count & kSeveralCharts) != 0);
    }
  }
}

}  // namespace atlasgauge
