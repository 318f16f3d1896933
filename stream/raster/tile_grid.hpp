#pragma once

#include <cstdint>
#include <vector>

#include "stream/mesh/triangle.hpp"
#include "stream/raster/square_grid.hpp"
#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {

/// The tiles of some levels of a slot, each level cut for itself, numbered level by level and row
/// by row. Rows of tiles are counted from the top of the image, as image files have it.
class TileGrid {
 public:
  /// Throws Error(kResource) for a texture of more tiles than can be numbered.
  TileGrid(const std::vector<LevelSize>& levels, std::int64_t tile_size);

  std::uint32_t level_count() const { return static_cast<std::uint32_t>(grids_.size()); }
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
    SquareGrid squares;
    std::uint32_t first_tile;
  };

  std::int64_t tile_size_;
  std::uint32_t tile_count_ = 0;
  std::vector<LevelGrid> grids_;
};

template <class Use>
void TileGrid::visit_touched(std::uint32_t level, const Texel (&corner)[3], Use use) const {
  const LevelGrid& grid = grids_[level];
  const auto top = static_cast<double>(grid.size.height);
  const Texel down[3] = {{corner[0].x, top - corner[0].y},
                         {corner[1].x, top - corner[1].y},
                         {corner[2].x, top - corner[2].y}};
  grid.squares.visit_touched(down, [&](std::int64_t column, std::int64_t row) {
    use(grid.first_tile + static_cast<std::uint32_t>(row * grid.squares.columns() + column));
  });
}

}  // namespace atlasgauge
