#include "stream/raster/box_filter.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "stream/raster/mip_levels.hpp"
#include "stream/raster/raster.hpp"

namespace atlasgauge {
namespace {

LevelTile tile_of(const LevelSize& size, const TexelRect& rect) {
  LevelTile tile;
  tile.size = size;
  tile.tile.reset(rect, size);
  return tile;
}

std::vector<std::uint32_t> numbers(std::span<const std::uint32_t> chosen) {
  return {chosen.begin(), chosen.end()};
}

TEST(BoxFilterTest, ATriangleBetweenCentresIsLeftOut) {
  const SlotFrame frame{true, true, 4, 4, 0, 0};
  BoxFilter filter(2);
  filter.clear();
  filter.add({{0.14F, 0.1F}, {0.35F, 0.1F}, {0.2F, 0.2F}}, frame);  // columns 0.56 to 1.4
  filter.add({{0.14F, 0.1F}, {0.39F, 0.1F}, {0.2F, 0.2F}}, frame);  // to 1.56
  EXPECT_EQ(numbers(filter.choose(tile_of({4, 4}, {0, 0, 4, 4}))), (std::vector<std::uint32_t>{1}));
}

TEST(BoxFilterTest, WhatIsRemovedIsNotChosen) {
  const SlotFrame frame{true, true, 4, 4, 0, 0};
  BoxFilter filter(2);
  filter.clear();
  for (int i = 0; i < 2; ++i) filter.add({{0, 0}, {1, 0}, {0, 1}}, frame);
  filter.remove(0);
  EXPECT_EQ(numbers(filter.choose(tile_of({4, 4}, {0, 0, 4, 4}))), (std::vector<std::uint32_t>{1}));
}

TEST(BoxFilterTest, ChoosesThoseWithCentresInTheBoxOfSnappedCorners) {
  const SlotFrame frame{true, true, 300, 200, 1, -2};
  const MipLevels levels = levels_of(frame);
  std::mt19937 random(3);
  constexpr std::uint32_t kTriangles = 500;
  std::vector<TexCoord[3]> triangles(kTriangles);
  BoxFilter filter(kTriangles);
  filter.clear();
  for (std::uint32_t i = 0; i < kTriangles; ++i) {
    std::uniform_real_distribution<float> place(-0.1F, 1.1F);
    std::uniform_int_distribution<int> offset(-2000, 2000);
    const float u = place(random) - 1, v = place(random) + 2;
    for (TexCoord& corner : triangles[i]) {
      // Some of them on centres of texels.
      corner = {u + static_cast<float>(offset(random)) / 1e5F,
                v + static_cast<float>(offset(random)) / 1e5F};
      if (i % 3 == 0) corner = {static_cast<float>(offset(random) / 100 - 19.5) / 300, corner.v};
      if (i % 100 == 7) corner.u *= 1e6F;
    }
    filter.add(triangles[i], frame);
  }
  std::size_t chosen = 0;
  for (std::uint32_t level = 0; level < levels.count(); ++level) {
    const LevelSize size = levels.size(level);
    const LevelTile tile = tile_of(size, {size.width / 3, 0, size.width, size.height / 2 + 1});
    std::vector<std::uint32_t> want;
    for (std::uint32_t i = 0; i < kTriangles; ++i) {
      const SnappedTriangle triangle = snapped(triangles[i], 0, at_level(frame, size));
      if (!centres_in_box(triangle, tile.tile.window()).empty()) want.push_back(i);
    }
    EXPECT_EQ(numbers(filter.choose(tile)), want) << "level " << level;
    chosen += want.size();
  }
  EXPECT_GT(chosen, kTriangles);
}

}  // namespace
}  // namespace atlasgauge
