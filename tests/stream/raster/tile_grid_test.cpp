#include "stream/raster/tile_grid.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "io/error.hpp"
#include "stream/raster/mip_levels.hpp"
#include "stream/raster/scalar_raster.hpp"

namespace atlasgauge {
namespace {

std::set<std::uint32_t> touched(const TileGrid& grid, std::uint32_t level,
                                const Texel (&corner)[3]) {
  std::set<std::uint32_t> tiles;
  grid.visit_touched(level, corner, [&](std::uint32_t tile) {
    EXPECT_TRUE(tiles.insert(tile).second) << "tile " << tile << " twice";
  });
  return tiles;
}

TEST(MipLevelsTest, HalveWithFloorWhileBothSidesLast) {
  const MipLevels levels(5, 300);
  ASSERT_EQ(levels.count(), 3U);
  EXPECT_EQ(levels.size(1).width, 2);
  EXPECT_EQ(levels.size(2).width, 1);
  EXPECT_EQ(levels.size(2).height, 75);
  EXPECT_EQ(MipLevels(1, 1).count(), 1U);
  EXPECT_EQ(MipLevels(65536, 65536).count(), 17U);
}

TEST(MipLevelsTest, FirstLevelWithinATileMayNotExist) {
  EXPECT_EQ(MipLevels(64, 64).first_within(64), 0U);
  EXPECT_EQ(MipLevels(65, 64).first_within(64), 1U);
  EXPECT_EQ(MipLevels(1, 1000).first_within(64), 1U) << "its only level is larger";
}

TEST(TileGridTest, TilesOfEveryLevelCoverItOnce) {
  for (const auto& [width, height] : {std::pair(100, 70), std::pair(64, 65), std::pair(33, 200)}) {
    const MipLevels levels(static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height));
    const TileGrid grid(levels.sizes(levels.first_within(16)), 16);
    std::vector<std::int64_t> area(grid.level_count(), 0);
    for (std::uint32_t tile = 0; tile < grid.tile_count(); ++tile) {
      const TexelRect rect = grid.rect_of(tile);
      const LevelSize size = levels.size(grid.level_of(tile));
      EXPECT_TRUE(rect.x0 >= 0 && rect.y0 >= 0 && rect.x1 <= size.width && rect.y1 <= size.height);
      EXPECT_TRUE(rect.x0 < rect.x1 && rect.y0 < rect.y1);
      EXPECT_LE(std::max(rect.width(), rect.height()), 16);
      EXPECT_EQ((size.height - rect.y1) % 16, 0) << "rows count from the top";
      area[grid.level_of(tile)] += rect.width() * rect.height();
    }
    for (std::uint32_t level = 0; level < grid.level_count(); ++level) {
      EXPECT_EQ(area[level], levels.size(level).width * levels.size(level).height);
    }
  }
}

TEST(TileGridTest, NoTileThatATriangleCoversIsLeftOut) {
  const MipLevels levels(200, 150);
  const TileGrid grid(levels.sizes(1), 16);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> near(-30, 230), far(-5000, 5000);
  ScalarRaster raster;
  TexelTile drawn;
  for (int i = 0; i < 400; ++i) {
    Texel corner[3];
    SnappedTriangle snapped{};
    for (int k = 0; k < 3; ++k) {
      corner[k] = i % 3 == 0 ? Texel{far(random), far(random)} : Texel{near(random), near(random)};
      if (i % 5 == 0 && k > 0) corner[k].x = corner[0].x + 0.01 * corner[k].x;
      snapped.x[k] = snap(corner[k].x);
      snapped.y[k] = snap(corner[k].y);
    }
    const std::set<std::uint32_t> tiles = touched(grid, 0, corner);
    for (std::uint32_t tile = 0; tile < grid.tile_count(); ++tile) {
      drawn.reset(grid.rect_of(tile), levels.size(0));
      raster.draw({&snapped, 1}, drawn);
      const std::uint32_t* counts = drawn.counts();
      const std::size_t texels =
          drawn.stride() * static_cast<std::size_t>(drawn.rect().height() + 2);
      const bool covers = std::any_of(counts, counts + texels, [](auto n) { return n != 0; });
      EXPECT_TRUE(!covers || tiles.contains(tile)) << "triangle " << i << ", tile " << tile;
    }
  }
}

TEST(TileGridTest, AThinDiagonalTouchesTheTilesAlongIt) {
  const TileGrid grid({{4096, 4096}}, 16);
  const Texel corner[3] = {{0, 0}, {4096, 4096}, {4095, 4096}};
  const std::size_t tiles = touched(grid, 0, corner).size();
  EXPECT_GE(tiles, 256U);
  EXPECT_LE(tiles, 4 * 256U);
}

TEST(TileGridTest, BeyondTheTextureTouchesNothing) {
  const TileGrid grid({{64, 64}}, 16);
  for (const double x : {-1e9, -2.0, 66.0, 1e9}) {
    const Texel corner[3] = {{x, 5}, {x, 6}, {x, 9}};
    EXPECT_TRUE(touched(grid, 0, corner).empty()) << x;
    const Texel turned[3] = {{5, x}, {6, x}, {9, x}};
    EXPECT_TRUE(touched(grid, 0, turned).empty()) << x;
  }
}

TEST(TileGridTest, MoreTilesThanCanBeNumberedAreRefused) {
  EXPECT_THROW(TileGrid({{std::int64_t{1} << 30, std::int64_t{1} << 30}}, 16), Error);
}

}  // namespace
}  // namespace atlasgauge
