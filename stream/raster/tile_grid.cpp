#include "stream/raster/tile_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

std::int64_t tiles_along(std::int64_t texels, std::int64_t tile_size) {
  return (texels + tile_size - 1) / tile_size;
}

}  // namespace

TileGrid::TileGrid(const std::vector<LevelSize>& levels, std::int64_t tile_size)
    : tile_size_(tile_size) {
  std::uint64_t tiles = 0;
  for (const LevelSize& size : levels) {
    const std::int64_t columns = tiles_along(size.width, tile_size);
    const std::int64_t rows = tiles_along(size.height, tile_size);
    grids_.push_back({size, columns, rows, static_cast<std::uint32_t>(tiles)});
    tiles += static_cast<std::uint64_t>(columns) * static_cast<std::uint64_t>(rows);
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
  std::uint32_t level = tiled_levels() - 1;
  while (grids_[level].first_tile > tile) --level;
  return level;
}

TexelRect TileGrid::rect_of(std::uint32_t tile) const {
  const LevelGrid& grid = grids_[level_of(tile)];
  const std::int64_t place = tile - grid.first_tile;
  const std::int64_t x0 = place % grid.columns * tile_size_;
  const std::int64_t y1 = grid.size.height - place / grid.columns * tile_size_;
  return {x0, std::max<std::int64_t>(0, y1 - tile_size_),
          std::min(grid.size.width, x0 + tile_size_), y1};
}

TileGrid::Range TileGrid::columns_between(const LevelGrid& grid, double low_x,
                                          double high_x) const {
  const auto size = static_cast<double>(tile_size_);
  const double first = std::max(0.0, std::floor((low_x - kReach) / size));
  const double last =
      std::min(static_cast<double>(grid.columns - 1), std::floor((high_x + kReach) / size));
  return {static_cast<std::int64_t>(first), static_cast<std::int64_t>(last)};
}

TileGrid::Range TileGrid::rows_between(const LevelGrid& grid, double low_y, double high_y) const {
  const auto size = static_cast<double>(tile_size_);
  const auto top = static_cast<double>(grid.size.height);
  const double first = std::max(0.0, std::floor((top - high_y - kReach) / size));
  const double last =
      std::min(static_cast<double>(grid.rows - 1), std::floor((top - low_y + kReach) / size));
  return {static_cast<std::int64_t>(first), static_cast<std::int64_t>(last)};
}

TileGrid::Range TileGrid::columns_in_row(const LevelGrid& grid, std::int64_t row,
                                         const Texel (&corner)[3]) const {
  const auto top = static_cast<double>(grid.size.height - row * tile_size_) + kReach;
  const double bottom = top - static_cast<double>(tile_size_) - 2 * kReach;
  double low_x = std::numeric_limits<double>::infinity(), high_x = -low_x;
  const auto add = [&](double x) {
    low_x = std::min(low_x, x);
    high_x = std::max(high_x, x);
  };
  for (int k = 0; k < 3; ++k) {
    const Texel &a = corner[k], &b = corner[(k + 1) % 3];
    if (a.y >= bottom && a.y <= top) add(a.x);
    for (const double y : {bottom, top}) {
      if ((a.y < y) != (b.y < y)) add(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
  }
  if (low_x > high_x) return {0, -1};
  return columns_between(grid, low_x, high_x);
}

}  // namespace atlasgauge
