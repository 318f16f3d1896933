#include "stream/raster/atlas_regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "stream/raster/raster.hpp"
#include "stream/raster/scalar_raster.hpp"

namespace atlasgauge {
namespace {

SlotFrame slot_of(double width, double height) {
  return {true, true, width, height, 0, 0};
}

/// Of odd sizes, powers of two, one texel wide, no size at all, and smaller than a square.
const std::vector<SlotFrame> kSlots{slot_of(100, 70), slot_of(64, 128), slot_of(255, 129), {},
                                    slot_of(1, 90),   slot_of(8, 8),    slot_of(33, 200)};
const std::vector<std::int64_t> kSides{1, 7, 8, 16, 64};

using TexCoords = TexCoord[3];

std::set<std::uint32_t> touched(const AtlasRegions& regions, std::uint32_t slot,
                                const TexCoords& uv) {
  std::set<std::uint32_t> numbers;
  regions.visit_touched(SlotId{slot}, uv, [&](std::uint32_t region) {
    EXPECT_TRUE(numbers.insert(region).second) << "region " << region << " twice";
  });
  return numbers;
}

/// The levels of a slot, as whole tiles.
std::vector<TexelTile> tiles_of(const SlotFrame& frame) {
  const MipLevels levels = levels_of(frame);
  std::vector<TexelTile> tiles(levels.count());
  for (std::uint32_t level = 0; level < levels.count(); ++level) {
    const LevelSize size = levels.size(level);
    tiles[level].reset({0, 0, size.width, size.height}, size);
  }
  return tiles;
}

bool covers_any(const TexelTile& tile, const TexelRect& rect) {
  for (std::int64_t y = rect.y0; y < rect.y1; ++y) {
    for (std::int64_t x = rect.x0; x < rect.x1; ++x) {
      if (tile.counts()[tile.index(x, y)] != 0) return true;
    }
  }
  return false;
}

/// With its halo, as far as the level goes.
TexelRect window_of(const TexelRect& rect, const LevelSize& size) {
  return {std::max<std::int64_t>(0, rect.x0 - 1), std::max<std::int64_t>(0, rect.y0 - 1),
          std::min(size.width, rect.x1 + 1), std::min(size.height, rect.y1 + 1)};
}

/// Large, small, thin and far ones.
void make_random(std::mt19937& random, int i, TexCoords& uv) {
  const auto between = [&](float low, float high) {
    return std::uniform_real_distribution<float>(low, high)(random);
  };
  const TexCoord place{between(-0.1F, 1.1F), between(-0.1F, 1.1F)};
  const float reach =
      std::vector<float>{0.003F, 0.03F, 0.3F, 3, 1000}[static_cast<std::size_t>(i % 5)];
  for (TexCoord& corner : uv) {
    corner = {place.u + between(-reach, reach), place.v + between(-reach, reach)};
  }
  if (i % 7 == 0) uv[2] = {uv[0].u + 0.01F * (uv[1].u - uv[0].u), uv[1].v};
}

TEST(AtlasRegionsTest, EveryTexelOfEveryLevelIsInOneRegionOrDrawnWhole) {
  for (const std::int64_t side : kSides) {
    SCOPED_TRACE("squares of " + std::to_string(side));
    const SlotFrames frames(kSlots);
    const AtlasRegions regions(frames, side);
    std::vector<std::vector<TexelTile>> tiles;
    for (const SlotFrame& frame : kSlots) {
      tiles.push_back(frame.has_size ? tiles_of(frame) : std::vector<TexelTile>());
    }
    const auto cover = [&](std::uint32_t slot, std::uint32_t level, const TexelRect& rect) {
      TexelTile& tile = tiles[slot][level];
      for (std::int64_t y = rect.y0; y < rect.y1; ++y) {
        for (std::int64_t x = rect.x0; x < rect.x1; ++x) tile.cover(tile.index(x, y), 1, 1, false);
      }
    };
    for (std::uint32_t number = 0; number < regions.count(); ++number) {
      const Region region = regions.region(number);
      const MipLevels levels = levels_of(frames.of(region.slot));
      for (std::uint32_t level = region.levels.first; level < region.levels.end; ++level) {
        const TexelRect rect = region.rect(level, levels.size(level));
        EXPECT_LE(std::max(rect.width(), rect.height()), side);
        cover(raw(region.slot), level, rect);
      }
    }
    for (std::uint32_t slot = 0; slot < kSlots.size(); ++slot) {
      if (!kSlots[slot].has_size) continue;
      const LevelRange whole = regions.whole_levels(SlotId{slot});
      for (std::uint32_t level = whole.first; level < whole.end; ++level) {
        const LevelSize size = levels_of(kSlots[slot]).size(level);
        EXPECT_LE(std::max(size.width, size.height), side);
        cover(slot, level, {0, 0, size.width, size.height});
      }
      for (const TexelTile& tile : tiles[slot]) {
        for (std::int64_t y = 0; y < tile.rect().y1; ++y) {
          for (std::int64_t x = 0; x < tile.rect().x1; ++x) {
            ASSERT_EQ(tile.counts()[tile.index(x, y)], 1U)
                << "slot " << slot << ", " << tile.rect().x1 << " columns, texel " << x << ", "
                << y;
          }
        }
      }
    }
  }
}

TEST(AtlasRegionsTest, ATriangleIsInEveryRegionItTouches) {
  std::mt19937 random(5);
  ScalarRaster raster;
  for (const std::int64_t side : kSides) {
    SCOPED_TRACE("squares of " + std::to_string(side));
    const SlotFrames frames(kSlots);
    const AtlasRegions regions(frames, side);
    for (int i = 0; i < 200; ++i) {
      const auto slot = static_cast<std::uint32_t>(random() % kSlots.size());
      if (!kSlots[slot].has_size) continue;
      TexCoords uv;
      make_random(random, i, uv);
      const std::set<std::uint32_t> found = touched(regions, slot, uv);
      const MipLevels levels = levels_of(kSlots[slot]);
      std::vector<TexelTile> drawn = tiles_of(kSlots[slot]);
      bool covers = false;
      for (std::uint32_t level = 0; level < levels.count(); ++level) {
        const SnappedTriangle triangle = snapped(uv, 0, at_level(kSlots[slot], levels.size(level)));
        raster.draw({&triangle, 1}, drawn[level]);
        covers = covers || covers_any(drawn[level], drawn[level].rect());
      }
      EXPECT_TRUE(!covers || !found.empty()) << "triangle " << i;
      for (std::uint32_t number = 0; number < regions.count(); ++number) {
        const Region region = regions.region(number);
        if (region.slot != SlotId{slot}) continue;
        for (std::uint32_t level = region.levels.first; level < region.levels.end; ++level) {
          const LevelSize size = levels.size(level);
          const TexelRect rect = region.rect(level, size);
          if (rect.empty() || !covers_any(drawn[level], window_of(rect, size))) continue;
          ASSERT_TRUE(found.contains(number)) << "triangle " << i << ", slot " << slot
                                              << ", region " << number << ", level " << level;
        }
      }
    }
  }
}

TEST(AtlasRegionsTest, ATriangleAmidASquareIsInOneRegionOfALargeTexture) {
  const SlotFrames frames({slot_of(8192, 8192)});
  const AtlasRegions regions(frames, 512);
  EXPECT_EQ(regions.count(), 256U);
  EXPECT_EQ(touched(regions, 0, {{0.51F, 0.51F}, {0.511F, 0.51F}, {0.51F, 0.511F}}),
            (std::set<std::uint32_t>{8 * 16 + 8}));
}

TEST(AtlasRegionsTest, NearABorderATriangleIsOnBothSidesOfIt) {
  const SlotFrames frames({slot_of(8192, 8192)});
  const AtlasRegions regions(frames, 512);
  // Level 3 is the last of 1024 texels or more: half of its texel is 4 of level 0.
  const auto at = [](float texel) { return texel / 8192; };
  const TexCoords near{{at(1020.5F), at(100)}, {at(1019), at(100)}, {at(1019), at(101)}};
  EXPECT_EQ(touched(regions, 0, near), (std::set<std::uint32_t>{1, 2}));
  const TexCoords far{{at(1019.5F), at(100)}, {at(1019), at(100)}, {at(1019), at(101)}};
  EXPECT_EQ(touched(regions, 0, far), (std::set<std::uint32_t>{1}));
}

TEST(AtlasRegionsTest, AThinDiagonalTouchesTheRegionsAlongIt) {
  const SlotFrames frames({slot_of(4096, 4096)});
  const AtlasRegions regions(frames, 16);
  const std::size_t first_tier = 256 * 256;
  const std::set<std::uint32_t> found = touched(regions, 0, {{0, 0}, {1, 1}, {0.9998F, 1}});
  const auto regions_of_first_tier =
      std::count_if(found.begin(), found.end(), [&](auto region) { return region < first_tier; });
  EXPECT_GE(regions_of_first_tier, 256);
  EXPECT_LE(regions_of_first_tier, 4 * 256);
}

TEST(AtlasRegionsTest, BeyondTheTextureATriangleTouchesNothing) {
  const SlotFrames frames({slot_of(64, 64)});
  const AtlasRegions regions(frames, 16);
  for (const float u : {-1e7F, -0.1F, 1.1F, 1e7F}) {
    EXPECT_TRUE(touched(regions, 0, {{u, 0.1F}, {u, 0.2F}, {u, 0.3F}}).empty()) << u;
    EXPECT_TRUE(touched(regions, 0, {{0.1F, u}, {0.2F, u}, {0.3F, u}}).empty()) << u;
  }
}

TEST(AtlasRegionsTest, CopiesOfSmallTrianglesAreFewHoweverManyLevelsThereAre) {
  for (const std::int64_t side : {16, 64, 512}) {
    const SlotFrames frames({slot_of(16384, 16384)});
    const AtlasRegions regions(frames, side);
    std::mt19937 random(6);
    std::uniform_real_distribution<float> place(0, 1);
    std::size_t copies = 0;
    for (int i = 0; i < 1000; ++i) {
      const float u = place(random), v = place(random);
      copies += touched(regions, 0, {{u, v}, {u, v}, {u, v}}).size();
    }
    EXPECT_LT(copies, regions.most_tiers() * 1000 * 25 / 16) << side;
  }
}

TEST(AtlasRegionsTest, ASlotThatFitsASquareIsOneRegion) {
  const SlotFrames frames({slot_of(64, 30), slot_of(2, 64)});
  const AtlasRegions regions(frames, 64);
  ASSERT_EQ(regions.count(), 2U);
  EXPECT_EQ(regions.region(1).slot, SlotId{1});
  EXPECT_EQ(regions.region(0).levels.end, 5U);
  EXPECT_EQ(regions.whole_levels(SlotId{0}).first, regions.whole_levels(SlotId{0}).end);
}

TEST(AtlasRegionsTest, MoreRegionsThanCanBeNumberedAreRefused) {
  const SlotFrames frames({slot_of(0x1p30, 0x1p30)});
  EXPECT_THROW(AtlasRegions(frames, 16), Error);
}

}  // namespace
}  // namespace atlasgauge
