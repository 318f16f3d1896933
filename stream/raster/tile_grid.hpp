#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "stream/mesh/triangle.hpp"
#include "stream/raster/mip_levels.hpp"
#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {

/// The tiles of some levels of a slot, numbered level by level and row by row. Rows of tiles are
/// counted from the top of the image, as image files have it; no count depends on where the borders
/// of tiles lie.
class TileGrid {
 public:
  /// Throws Error(kResource) for a texture of more tiles than can be numbered.
  TileGrid(const std::vector<LevelSize>& levels, std::int64_t tile_size);
  /// Of those levels that do not fit one tile.
  TileGrid(const MipLevels& levels, std::int64_t tile_size)
      : TileGrid(levels.sizes(levels.first_within(tile_size)), tile_size) {}

  std::uint32_t tiled_levels() const { return static_cast<std::uint32_t>(grids_.size()); }
  std::uint32_t tile_count() const { return tile_count_; }
  std::uint32_t level_of(std::uint32_t tile) const;
  TexelRect rect_of(std::uint32_t tile) const;

  /// Calls use(tile) for every tile of the level that the triangle may touch, its halo included: no
  /// more than a few beside those it does, however large or thin it is. `corner` in texels of the
  /// level.
  template <class Use>
  void visit_touched(std::uint32_t level, const Texel (&corner)[3], Use use) const;

 private:
  struct LevelGrid {
    LevelSize size;
    std::int64_t columns, rows;
    std::uint32_t first_tile;
  };
  /// Columns or rows [first, last] of tiles.
  struct Range {
    std::int64_t first, last;
    bool empty() const { return first > last; }
  };
  /// More than the halo and the rounding to 1/256 texel.
  static constexpr double kReach = 1.25;

  Range columns_between(const LevelGrid& grid, double low_x, double high_x) const;
  Range rows_between(const LevelGrid& grid, double low_y, double high_y) const;
  /// The columns that the part of the triangle near one row of tiles may touch.
  Range columns_in_row(const LevelGrid& grid, std::int64_t row, const Texel (&corner)[3]) const;

  std::int64_t tile_size_;
  std::uint32_t tile_count_ = 0;
  std::vector<LevelGrid> grids_;
};

template <class Use>
void TileGrid::visit_touched(std::uint32_t level, const Texel (&corner)[3], Use use) const {
  const LevelGrid& grid = grids_[level];
  const auto [low_x, high_x] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
  const auto [low_y, high_y] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
  const Range columns = columns_between(grid, low_x, high_x);
  const Range rows = rows_between(grid, low_y, high_y);
  if (columns.empty() || rows.empty()) return;
  const bool few = columns.last - columns.first <= 1 || rows.last == rows.first;
  for (std::int64_t row = rows.first; row <= rows.last; ++row) {
    const Range in_row = few ? columns : columns_in_row(grid, row, corner);
    for (std::int64_t column = in_row.first; column <= in_row.last; ++column) {
      use(grid.first_tile + static_cast<std::uint32_t>(row * grid.columns + column));
    }
  }
}

}  // namespace atlasgauge
