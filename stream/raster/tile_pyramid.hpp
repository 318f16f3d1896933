#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {

/// What covers one texel of a pyramid.
struct CoveredTexel {
  std::uint32_t tile;                   ///< position in the pyramid
  std::uint32_t at;                     ///< position in the tile
  std::uint32_t count, chart_plus_one;  ///< words of TexelTile
};

/// A tile of a level, with what to know of the level.
struct LevelTile {
  std::uint32_t level = 0;
  LevelSize size;
  TexelTile tile;
};

/// Tiles of several levels of one slot.
class TilePyramid {
 public:
  /// Starts over without tiles. Keeps its memory.
  void clear() { count_ = 0; }
  void add(std::uint32_t level, const LevelSize& size, const TexelRect& rect) {
    if (count_ == tiles_.size()) tiles_.emplace_back();
    LevelTile& tile = tiles_[count_++];
    tile.level = level;
    tile.size = size;
    tile.tile.reset(rect, size);
  }

  bool empty() const { return count_ == 0; }
  std::span<LevelTile> tiles() { return {tiles_.data(), count_}; }
  std::span<const LevelTile> tiles() const { return {tiles_.data(), count_}; }

  /// Adds what was drawn into another pyramid of the same tiles.
  void merge(const TilePyramid& other) {
    for (std::size_t i = 0; i < count_; ++i) tiles_[i].tile.merge(other.tiles_[i].tile);
  }
  void cover(const CoveredTexel& texel) {
    tiles_[texel.tile].tile.cover(texel.at, texel.count & ~TexelTile::kSeveralCharts,
                                  texel.chart_plus_one,
                                  (texel.count & TexelTile::kSeveralCharts) != 0);
  }

  /// Calls use(CoveredTexel) for every covered texel, halos included.
  template <class Use>
  void visit_covered(Use use) const {
    for (std::uint32_t i = 0; i < count_; ++i) {
      const TexelTile& tile = tiles_[i].tile;
      for (std::uint32_t at = 0; at < tile.texels(); ++at) {
        if (tile.counts()[at] != 0) use({i, at, tile.counts()[at], tile.charts()[at]});
      }
    }
  }

 private:
  std::vector<LevelTile> tiles_;  ///< more than are in use, where there were more once
  std::size_t count_ = 0;
};

}  // namespace atlasgauge
