#include "stream/raster/whole_levels.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

/// Two slots whose levels 4x4, 2x2 and 1x1 are drawn whole.
struct Setting {
  explicit Setting(std::vector<std::uint32_t> all_triangles)
      : triangles(std::move(all_triangles)), whole(engine, frames, regions, triangles, parts) {}

  /// Covers the first texel of every level.
  void draw(std::size_t worker, std::uint32_t slot, std::uint32_t chart) {
    for (LevelTile& tile : whole.tiles_of(worker, SlotId{slot}).tiles()) {
      tile.tile.cover(tile.tile.index(0, 0), 1, chart + 1, false);
    }
    whole.add(worker, 1);
  }
  std::vector<LevelPart> finish() {
    whole.finish();
    return records_of(parts.finish());
  }

  TestEngine engine;
  SlotFrames frames{{{true, true, 8, 8, 0, 0}, {true, true, 8, 8, 0, 0}}};
  AtlasRegions regions{frames, 4};
  std::vector<std::uint32_t> triangles;
  LevelParts parts{engine.scratch};
  WholeLevels whole;
};

TEST(WholeLevelsTest, AreThoseThatFitASquare) {
  Setting setting({0, 0});
  const TilePyramid& tiles = setting.whole.tiles_of(0, SlotId{1});
  ASSERT_EQ(tiles.tiles().size(), 3U);
  EXPECT_EQ(tiles.tiles()[0].level, 1U);
  EXPECT_EQ(tiles.tiles()[0].tile.rect().width(), 4);
  EXPECT_EQ(tiles.tiles()[2].tile.rect().width(), 1);
}

TEST(WholeLevelsTest, ASlotThatOneWorkerDrewIsCountedOnce) {
  Setting setting({2, 1});
  setting.draw(0, 0, 5);
  setting.draw(0, 0, 5);
  setting.draw(0, 1, 5);
  const std::vector<LevelPart> parts = setting.finish();
  ASSERT_EQ(parts.size(), 2 * 3U);
  EXPECT_EQ(parts[0].slot, SlotId{0});
  EXPECT_EQ(parts[0].counts.drawn, 2U);
  EXPECT_EQ(parts[3].slot, SlotId{1});
  EXPECT_EQ(parts[3].counts.drawn, 1U);
  EXPECT_EQ(setting.whole.counted(), 2U);
}

TEST(WholeLevelsTest, WhatTwoWorkersDrewIsPutTogether) {
  Setting setting({3, 2});
  setting.draw(0, 0, 5);
  setting.draw(1, 0, 7);
  setting.draw(1, 1, 7);
  setting.draw(0, 1, 7);
  setting.draw(0, 0, 5);  // which it has left already
  const std::vector<LevelPart> parts = setting.finish();
  ASSERT_EQ(parts.size(), 2 * 3U);
  for (const LevelPart& part : parts) {
    const bool is_first = part.slot == SlotId{0};
    EXPECT_EQ(part.counts.drawn, is_first ? 3U : 2U);
    EXPECT_EQ(part.counts.covered, 1U);
    EXPECT_EQ(part.counts.overlaps_between, is_first ? 1U : 0U);
  }
}

}  // namespace
}  // namespace atlasgauge
