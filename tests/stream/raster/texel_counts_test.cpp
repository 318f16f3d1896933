#include "stream/raster/texel_counts.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

namespace atlasgauge {
namespace {

/// Texels by letter, the top row first: '.' uncovered, 'a' chart 0, 'b' chart 1, ...; a capital is
/// covered twice by its chart, '*' by charts 0 and 25.
TexelTile tile_of(const std::vector<std::string>& rows) {
  const auto height = static_cast<std::int64_t>(rows.size());
  const auto width = static_cast<std::int64_t>(rows[0].size());
  TexelTile tile;
  tile.reset({0, 0, width, height}, {width, height});
  for (std::int64_t y = 0; y < height; ++y) {
    for (std::int64_t x = 0; x < width; ++x) {
      const char letter =
          rows[static_cast<std::size_t>(height - 1 - y)][static_cast<std::size_t>(x)];
      const std::size_t at = tile.index(x, y);
      if (letter >= 'a' && letter <= 'z') {
        tile.cover(at, 1, static_cast<std::uint32_t>(letter - 'a') + 1, false);
      } else if (letter >= 'A' && letter <= 'Z') {
        tile.cover(at, 2, static_cast<std::uint32_t>(letter - 'A') + 1, false);
      } else if (letter == '*') {
        tile.cover(at, 1, 1, false);
        tile.cover(at, 1, 26, false);
      }
    }
  }
  return tile;
}

TEST(TexelCountsTest, OneTexelInTheMiddle) {
  const TexelCounts counts = count_texels(tile_of({".....", ".....", "..a..", ".....", "....."}));
  EXPECT_EQ(counts.covered, 1U);
  EXPECT_EQ(counts.drawn, 1U);
  EXPECT_EQ(counts.bilinear, 9U);
  EXPECT_EQ(counts.boundary, 1U);
  EXPECT_EQ(counts.clashes, 0U);
}

TEST(TexelCountsTest, OnTheRimNeighboursBeyondTheLevelAreNoTexels) {
  const TexelCounts counts = count_texels(tile_of({"a..", "...", "..."}));
  EXPECT_EQ(counts.bilinear, 4U);
  EXPECT_EQ(counts.boundary, 1U);
}

TEST(TexelCountsTest, TheRimIsBoundary) {
  EXPECT_EQ(count_texels(tile_of({"aaaa", "aaaa", "aaaa", "aaaa"})).boundary, 12U);
}

TEST(TexelCountsTest, ClashesAreAmongAllEightNeighbours) {
  EXPECT_EQ(count_texels(tile_of({"ab", "..", "c."})).clashes, 2U) << "side by side";
  EXPECT_EQ(count_texels(tile_of({"a.", ".b"})).clashes, 2U) << "across the corner";
  EXPECT_EQ(count_texels(tile_of({"a.b"})).clashes, 0U) << "not over a gap";
  EXPECT_EQ(count_texels(tile_of({"aab"})).clashes, 2U);
}

TEST(TexelCountsTest, ATexelOfSeveralChartsBelongsToTheHighest) {
  EXPECT_EQ(count_texels(tile_of({"*z"})).clashes, 0U);
  EXPECT_EQ(count_texels(tile_of({"*a"})).clashes, 2U);
}

TEST(TexelCountsTest, OverlapWithinAndBetweenCharts) {
  const TexelCounts counts = count_texels(tile_of({"A*a", "...", "B.b"}));
  EXPECT_EQ(counts.covered, 5U);
  EXPECT_EQ(counts.drawn, 8U);
  EXPECT_EQ(counts.overwritten, 3U);
  EXPECT_EQ(counts.lost, 3U);
  EXPECT_EQ(counts.overlaps_between, 1U);
}

TEST(TexelCountsTest, TheHaloServesAsNeighbour) {
  TexelTile tile;
  tile.reset({4, 4, 6, 6}, {10, 10});
  tile.cover(tile.index(3, 3), 1, 1, false);
  TexelCounts counts = count_texels(tile);
  EXPECT_EQ(counts.covered, 0U);
  EXPECT_EQ(counts.bilinear, 1U);
  tile.cover(tile.index(4, 4), 1, 2, false);
  counts = count_texels(tile);
  EXPECT_EQ(counts.clashes, 1U);
  EXPECT_EQ(counts.covered, 1U);
}

/// By the words of the definitions.
TexelCounts naive(const TexelTile& tile) {
  TexelCounts counts;
  const auto n = [&](std::int64_t x, std::int64_t y) {
    return tile.counts()[tile.index(x, y)] & ~TexelTile::kSeveralCharts;
  };
  for (std::int64_t y = tile.rect().y0; y < tile.rect().y1; ++y) {
    for (std::int64_t x = tile.rect().x0; x < tile.rect().x1; ++x) {
      bool any = false, hole = false, other = false;
      for (std::int64_t dy = -1; dy <= 1; ++dy) {
        for (std::int64_t dx = -1; dx <= 1; ++dx) {
          const bool covered = n(x + dx, y + dy) > 0;
          any = any || covered;
          hole = hole || !covered;
          other = other || (covered && tile.charts()[tile.index(x + dx, y + dy)] !=
                                           tile.charts()[tile.index(x, y)]);
        }
      }
      const std::uint32_t here = n(x, y);
      counts.drawn += here;
      counts.covered += here > 0 ? 1 : 0;
      counts.bilinear += any ? 1 : 0;
      counts.boundary += here > 0 && hole ? 1 : 0;
      counts.clashes += here > 0 && other ? 1 : 0;
      counts.overwritten += here > 1 ? 1 : 0;
      counts.lost += here > 1 ? here - 1 : 0;
      counts.overlaps_between += tile.counts()[tile.index(x, y)] != here ? 1 : 0;
    }
  }
  return counts;
}

TEST(TexelCountsTest, RandomTilesAgreeWithTheDefinitions) {
  std::mt19937 random(5);
  for (int i = 0; i < 60; ++i) {
    const auto width = static_cast<std::int64_t>(1 + random() % 40);
    const auto height = static_cast<std::int64_t>(1 + random() % 40);
    TexelTile tile;
    tile.reset({8, 8, 8 + width, 8 + height}, {100, 100});
    const auto often = 1 + random() % 8;
    for (std::int64_t y = 7; y <= 8 + height; ++y) {
      for (std::int64_t x = 7; x <= 8 + width; ++x) {
        for (auto k = random() % (often + 1); k > 1; --k) {
          tile.cover(tile.index(x, y), 1, static_cast<std::uint32_t>(1 + random() % 3), false);
        }
      }
    }
    const TexelCounts found = count_texels(tile), expected = naive(tile);
    EXPECT_EQ(found.covered, expected.covered);
    EXPECT_EQ(found.drawn, expected.drawn);
    EXPECT_EQ(found.bilinear, expected.bilinear);
    EXPECT_EQ(found.boundary, expected.boundary);
    EXPECT_EQ(found.clashes, expected.clashes);
    EXPECT_EQ(found.overwritten, expected.overwritten);
    EXPECT_EQ(found.lost, expected.lost);
    EXPECT_EQ(found.overlaps_between, expected.overlaps_between);
  }
}

}  // namespace
}  // namespace atlasgauge
