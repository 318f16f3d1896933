#pragma once

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <utility>
#include <vector>

#include "stream/raster/raster.hpp"
#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {

inline TexelTile tile_of(const TexelRect& rect, const LevelSize& level) {
  TexelTile tile;
  tile.reset(rect, level);
  return tile;
}

/// Corners in texels.
inline SnappedTriangle triangle(std::pair<double, double> a, std::pair<double, double> b,
                                std::pair<double, double> c, std::uint32_t chart = 0) {
  return {{snap(a.first), snap(b.first), snap(c.first)},
          {snap(a.second), snap(b.second), snap(c.second)},
          chart};
}

/// The half-space rule, for one texel.
inline bool covers(const SnappedTriangle& t, std::int64_t x, std::int64_t y) {
  __extension__ typedef __int128 Int128;
  const auto cross = [](std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by) {
    return static_cast<Int128>(ax) * by - static_cast<Int128>(bx) * ay;
  };
  const Int128 area = cross(t.x[1] - t.x[0], t.y[1] - t.y[0], t.x[2] - t.x[0], t.y[2] - t.y[0]);
  if (area == 0) return false;
  const std::int64_t cx = 256 * x + 128, cy = 256 * y + 128;
  for (int k = 0; k < 3; ++k) {
    int i = k, j = (k + 1) % 3;
    if (area < 0) std::swap(i, j);
    const std::int64_t dx = t.x[j] - t.x[i], dy = t.y[j] - t.y[i];
    const Int128 side = cross(dx, dy, cx - t.x[i], cy - t.y[i]);
    const bool left_or_lower = dy < 0 || (dy == 0 && dx > 0);
    if (left_or_lower ? side < 0 : side <= 0) return false;
  }
  return true;
}

inline void draw_naively(std::span<const SnappedTriangle> triangles, TexelTile& tile) {
  const TexelRect& window = tile.window();
  for (const SnappedTriangle& t : triangles) {
    for (std::int64_t y = window.y0; y < window.y1; ++y) {
      for (std::int64_t x = window.x0; x < window.x1; ++x) {
        if (covers(t, x, y)) tile.cover(tile.index(x, y), 1, t.chart + 1, false);
      }
    }
  }
}

/// Vertices on a lattice of `step`, within `reach` of a random place near a square of `size`
/// texels.
inline std::vector<SnappedTriangle> random_triangles(std::mt19937& random, std::size_t count,
                                                     std::int64_t size, std::int64_t reach,
                                                     std::int64_t step) {
  std::uniform_int_distribution<std::int64_t> place(-64 * 256, (size + 64) * 256);
  std::uniform_int_distribution<std::int64_t> offset(-reach, reach);
  std::uniform_int_distribution<std::uint32_t> chart(0, 5);
  std::vector<SnappedTriangle> triangles(count);
  for (SnappedTriangle& t : triangles) {
    const std::int64_t x = place(random), y = place(random);
    for (int k = 0; k < 3; ++k) {
      t.x[k] = (x + offset(random)) / step * step;
      t.y[k] = (y + offset(random)) / step * step;
    }
    t.chart = chart(random);
  }
  return triangles;
}

/// Every texel of the tiles and their halos.
inline void expect_equal(const TexelTile& a, const TexelTile& b) {
  for (std::int64_t y = a.rect().y0 - 1; y <= a.rect().y1; ++y) {
    for (std::int64_t x = a.rect().x0 - 1; x <= a.rect().x1; ++x) {
      const std::size_t at = a.index(x, y);
      if (a.counts()[at] == b.counts()[at] && a.charts()[at] == b.charts()[at]) continue;
      FAIL() << "texel " << x << ", " << y << ": counts " << a.counts()[at] << " and "
             << b.counts()[at] << ", charts " << a.charts()[at] << " and " << b.charts()[at];
    }
  }
}

/// Of the tile without its halo.
inline std::uint64_t covered_texels(const TexelTile& tile) {
  std::uint64_t texels = 0;
  for (std::int64_t y = tile.rect().y0; y < tile.rect().y1; ++y) {
    for (std::int64_t x = tile.rect().x0; x < tile.rect().x1; ++x) {
      if (tile.counts()[tile.index(x, y)] != 0) ++texels;
    }
  }
  return texels;
}

}  // namespace atlasgauge
