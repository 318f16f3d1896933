#include "stream/raster/tile_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

/// More than the halo and the rounding to 1/256 texel.
constexpr double kReach = 1.25;

}  // namespace

TileGrid::TileGrid(const std::vector<LevelSize>& levels, std::int64_t tile_size)
    : tile_size_(tile_size) {
  std::uint64_t tiles = 0;
  for (const LevelSize& size : levels) {
    const SquareGrid squares(size, tile_size, {kReach, kReach});
    grids_.push_back({size, squares, static_cast<std::uint32_t>(tiles)});
    tiles +=
        static_cast<std::uint64_t>(squares.columns()) * static_cast<std::uint64_t>(squares.rows());
    if (tiles > std::numeric_limits<std::int32_t>::max()) {
      throw Error(ErrorKind::kResource,
                  fmt::format("a texture of {} x {} texels has too many tiles; give more memory "
                              "with --memory, or a smaller texture",
                              levels[0].width, levels[0].height));
    }
  }
  tile_count_ = static_cast<std::uint32_t>(tiles);
}

std::uint32_t TileGrid::level_of(std::uint32_t tile) const {
  std::uint32_t level = level_count() - 1;
  while (grids_[level].first_tile > tile) --level;
  return level;
}

TexelRect TileGrid::rect_of(std::uint32_t tile) const {
  const LevelGrid& grid = grids_[level_of(tile)];
  const std::int64_t place = tile - grid.first_tile;
  const std::int64_t x0 = place % grid.squares.columns() * tile_size_;
  const std::int64_t y1 = grid.size.height - place / grid.squares.columns() * tile_size_;
  return {x0, std::max<std::int64_t>(0, y1 - tile_size_),
          std::min(grid.size.width, x0 + tile_size_), y1};
}

}  // namespace atlasgauge
