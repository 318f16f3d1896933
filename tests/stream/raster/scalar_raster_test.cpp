#include "stream/raster/scalar_raster.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/support/raster_scene.hpp"

namespace atlasgauge {
namespace {

void expect_as_naive(const std::vector<SnappedTriangle>& triangles, const TexelRect& rect,
                     const LevelSize& level) {
  TexelTile drawn = tile_of(rect, level);
  ScalarRaster().draw(triangles, drawn);
  TexelTile naive = tile_of(rect, level);
  draw_naively(triangles, naive);
  expect_equal(drawn, naive);
}

TEST(ScalarRasterTest, CoversTheCentresLeftAndBelowInclusive) {
  TexelTile tile = tile_of({0, 0, 4, 4}, {4, 4});
  // Its legs run through centres: those on the left and the lower leg count, those on the
  // hypotenuse, a right edge, do not.
  ScalarRaster().draw(std::vector{triangle({0.5, 0.5}, {3.5, 0.5}, {0.5, 3.5}, 7)}, tile);
  const auto count = [&](int x, int y) { return tile.counts()[tile.index(x, y)]; };
  EXPECT_EQ(count(0, 0), 1U);
  EXPECT_EQ(count(2, 0), 1U);
  EXPECT_EQ(count(3, 0), 0U);
  EXPECT_EQ(count(0, 2), 1U);
  EXPECT_EQ(count(0, 3), 0U);
  EXPECT_EQ(count(1, 1), 1U);
  EXPECT_EQ(count(2, 1), 0U);
  EXPECT_EQ(covered_texels(tile), 6U);
  EXPECT_EQ(tile.charts()[tile.index(0, 0)], 8U);
}

TEST(ScalarRasterTest, TexelsOnASharedEdgeAreCoveredOnce) {
  TexelTile tile = tile_of({0, 0, 8, 8}, {8, 8});
  ScalarRaster().draw(
      std::vector{triangle({0, 0}, {8, 0}, {8, 8}), triangle({0, 0}, {8, 8}, {0, 8})}, tile);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) EXPECT_EQ(tile.counts()[tile.index(x, y)], 1U) << x << ", " << y;
  }
}

TEST(ScalarRasterTest, NotesTheHighestChartAndWhetherThereAreSeveral) {
  TexelTile tile = tile_of({0, 0, 1, 1}, {1, 1});
  const auto whole = [](std::uint32_t chart) {
    return triangle({-3, -3}, {9, -3}, {-3, 9}, chart);
  };
  ScalarRaster raster;
  raster.draw(std::vector{whole(5), whole(5)}, tile);
  EXPECT_EQ(tile.counts()[tile.index(0, 0)], 2U);
  raster.draw(std::vector{whole(3)}, tile);
  EXPECT_EQ(tile.counts()[tile.index(0, 0)], 3U | TexelTile::kSeveralCharts);
  EXPECT_EQ(tile.charts()[tile.index(0, 0)], 6U);
}

TEST(ScalarRasterTest, DrawsIntoTheHaloButNotBeyondTheLevel) {
  TexelTile tile = tile_of({2, 0, 4, 2}, {5, 2});
  ScalarRaster().draw(std::vector{triangle({-9, -9}, {99, -9}, {-9, 99})}, tile);
  EXPECT_EQ(tile.counts()[tile.index(1, 0)], 1U);
  EXPECT_EQ(tile.counts()[tile.index(4, 1)], 1U);
  EXPECT_EQ(tile.counts()[tile.index(2, -1)], 0U);
  EXPECT_EQ(tile.counts()[tile.index(2, 2)], 0U);
}

TEST(ScalarRasterTest, CountsTheTrianglesThatMayTouchTheTile) {
  TexelTile tile = tile_of({0, 0, 4, 4}, {4, 4});
  ScalarRaster raster;
  raster.draw(std::vector{triangle({0, 0}, {4, 0}, {0, 4}), triangle({9, 9}, {12, 9}, {9, 12}),
                          triangle({1.6, 1.6}, {2.4, 1.6}, {1.6, 2.4})},
              tile);
  EXPECT_EQ(raster.tally().scalar, 1U);
}

TEST(ScalarRasterTest, AgreesWithTheHalfSpaceRule) {
  std::mt19937 random(1);
  for (const std::int64_t reach : {40, 300, 2000, 20000, 200000}) {
    for (const std::int64_t step : {1, 64, 128, 256}) {
      SCOPED_TRACE(testing::Message() << "reach " << reach << ", step " << step);
      expect_as_naive(random_triangles(random, 150, 37, reach, step), {0, 0, 37, 21}, {37, 21});
      expect_as_naive(random_triangles(random, 150, 60, reach, step), {16, 8, 32, 24}, {60, 33});
    }
  }
}

TEST(ScalarRasterTest, AgreesForTrianglesOfATexelOrTwo) {
  std::mt19937 random(3);
  for (const std::int64_t step : {1, 64, 128}) {
    for (const std::int64_t reach : {100, 250, 400}) {
      expect_as_naive(random_triangles(random, 800, 64, reach, step), {0, 0, 64, 64}, {64, 64});
    }
  }
}

TEST(ScalarRasterTest, AgreesForTrianglesThatReachToTheLimit) {
  std::mt19937 random(2);
  const std::int64_t limit = std::int64_t{1} << 38;
  std::uniform_int_distribution<std::int64_t> far(-limit, limit);
  std::vector<SnappedTriangle> triangles = random_triangles(random, 300, 30, 3000, 1);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    SnappedTriangle& t = triangles[i];
    for (std::size_t k = 0; k <= i % 3; ++k) {
      t.x[k] = far(random);
      t.y[k] = far(random);
    }
  }
  expect_as_naive(triangles, {3, 5, 21, 28}, {30, 30});
}

TEST(ScalarRasterTest, DegenerateTrianglesCoverNothing) {
  TexelTile tile = tile_of({0, 0, 8, 8}, {8, 8});
  ScalarRaster().draw(
      std::vector{triangle({0.5, 0.5}, {6.5, 6.5}, {3.5, 3.5}), triangle({1, 2}, {1, 2}, {1, 2}),
                  triangle({0.5, 2.5}, {7.5, 2.5}, {3.5, 2.5}),
                  triangle({2.5, 0}, {2.5, 9}, {2.5, 4})},
      tile);
  EXPECT_EQ(covered_texels(tile), 0U);
}

TEST(TexelTileTest, MergeIsTheSameAsDrawingIntoOne) {
  std::mt19937 random(3);
  const std::vector<SnappedTriangle> all = random_triangles(random, 400, 20, 2000, 1);
  TexelTile whole = tile_of({0, 0, 20, 20}, {20, 20});
  ScalarRaster().draw(all, whole);
  TexelTile parts = tile_of({0, 0, 20, 20}, {20, 20});
  TexelTile other = parts;
  ScalarRaster().draw({all.data(), 150}, parts);
  ScalarRaster().draw({all.data() + 150, 250}, other);
  parts.merge(other);
  expect_equal(whole, parts);
}

}  // namespace
}  // namespace atlasgauge
