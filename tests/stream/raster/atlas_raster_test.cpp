// The atlas in tiles of any size and in any memory, against levels that are drawn whole.

#include "stream/raster/atlas_raster.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "io/ids.hpp"
#include "stream/raster/mip_levels.hpp"
#include "stream/raster/raster.hpp"
#include "stream/raster/scalar_raster.hpp"
#include "stream/raster/texel_counts.hpp"
#include "tests/stream/mesh/stages.hpp"
#include "tests/support/engine_fixture.hpp"
#include "tests/support/raster_scene.hpp"

namespace atlasgauge {

static bool operator==(const TexelCounts& a, const TexelCounts& b) {
  const auto numbers = [](const TexelCounts& c) {
    return std::array{c.covered, c.drawn,    c.bilinear, c.overwritten,
                      c.lost,    c.boundary, c.clashes,  c.overlaps_between};
  };
  return numbers(a) == numbers(b);
}

static bool operator==(const TextureLevel& a, const TextureLevel& b) {
  return a.slot == b.slot && a.level == b.level && a.width == b.width && a.height == b.height &&
         a.counts == b.counts;
}

/// What a failing test prints.
static void PrintTo(const TextureLevel& level, std::ostream* out) {
  *out << "slot " << raw(level.slot) << ", level " << level.level << ": " << level.counts.covered
       << " covered, " << level.counts.drawn << " drawn, " << level.counts.bilinear << " bilinear, "
       << level.counts.boundary << " boundary, " << level.counts.clashes << " clashes, "
       << level.counts.overlaps_between << " overlaps between";
}

namespace {

/// Faces by slot and chart, and the sizes of the slots.
struct Atlas {
  std::vector<SlotFrame> frames;
  std::vector<AtlasFace> faces;
  std::vector<Label> charts;

  void slot(double width, double height, double shift_u = 0, double shift_v = 0) {
    frames.push_back({true, true, width, height, shift_u, shift_v});
  }
  void slot_without_size() { frames.emplace_back(); }

  /// Corners in texels of the slot.
  void face(std::uint32_t slot, const std::array<Texel, 3>& corners, std::uint32_t chart = 0,
            bool drawn = true) {
    const SlotFrame& frame = frames[slot];
    Triangle triangle{};
    triangle.slot = SlotId{slot};
    triangle.kind = FaceKind::kWhole;
    triangle.has_uv_triangle = true;
    triangle.uv_far = !drawn;
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.t[k] = {static_cast<float>(corners[k].x / frame.width - frame.shift_u),
                       static_cast<float>(corners[k].y / frame.height - frame.shift_v)};
    }
    faces.emplace_back(triangle);
    charts.emplace_back(chart, false, false);
  }
  /// Covers all of a slot.
  void full_face(std::uint32_t slot, std::uint32_t chart = 0) {
    const SlotFrame& frame = frames[slot];
    face(slot, {{{0, 0}, {2 * frame.width, 0}, {0, 2 * frame.height}}}, chart);
  }
};

struct Knobs {
  std::int64_t tile_size = 16;
  std::uint64_t budget_bytes = 64 << 20;
  std::size_t workers = 2;
};

struct Drawn {
  std::vector<TextureLevel> groups;  ///< as the sink was given them
  std::vector<TextureLevel> levels;  ///< as later stages read them
  RasterWork work;
  std::size_t workers_busy = 0;
};

Drawn draw(const Atlas& atlas, const Knobs& knobs) {
  TestEngine engine({.budget_bytes = knobs.budget_bytes, .workers = knobs.workers});
  Spill<Label> charts = spill_of(engine, atlas.charts);
  Spill<AtlasFace> faces = spill_of(engine, atlas.faces);
  const SlotFrames frames(atlas.frames);
  const RasterPlan plan{[] { return std::make_unique<ScalarRaster>(); }, knobs.tile_size};
  GroupCollector groups;
  RasterResults results = raster_atlas(engine, charts, faces, frames, plan, groups);
  return {groups.levels, records_of(results.levels), results.work,
          engine.log.stages().back().workers_busy};
}

/// Every level as one tile, texel by texel.
std::vector<TextureLevel> draw_whole_levels(const Atlas& atlas) {
  std::vector<TextureLevel> all;
  for (std::uint32_t slot = 0; slot < atlas.frames.size(); ++slot) {
    const SlotFrame& frame = atlas.frames[slot];
    if (!frame.has_size) continue;
    const auto width = static_cast<std::uint64_t>(frame.width);
    const auto height = static_cast<std::uint64_t>(frame.height);
    const MipLevels levels(width, height);
    for (std::uint32_t level = 0; level < levels.count(); ++level) {
      const LevelSize size = levels.size(level);
      TexelTile tile = tile_of({0, 0, size.width, size.height}, size);
      std::vector<SnappedTriangle> triangles;
      for (std::size_t i = 0; i < atlas.faces.size(); ++i) {
        const AtlasFace& face = atlas.faces[i];
        if (face.slot() != SlotId{slot} || !face.is_drawn()) continue;
        triangles.push_back(snapped(face.uv(), atlas.charts[i].first(), at_level(frame, size)));
      }
      draw_naively(triangles, tile);
      all.push_back({SlotId{slot}, level, width >> level, height >> level, count_texels(tile)});
    }
  }
  return all;
}

void expect_whole_levels(const Atlas& atlas, const Knobs& knobs) {
  const std::vector<TextureLevel> want = draw_whole_levels(atlas);
  const Drawn drawn = draw(atlas, knobs);
  EXPECT_EQ(drawn.groups, want);
  EXPECT_EQ(drawn.levels, want);
}

/// Within `reach` of a random place near the slot, some of them degenerate.
void add_random_faces(Atlas& atlas, std::uint32_t slot, std::size_t count, double reach,
                      std::mt19937& random) {
  const SlotFrame frame = atlas.frames[slot];
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (std::size_t i = 0; i < count; ++i) {
    const Texel place{between(-10, frame.width + 10), between(-10, frame.height + 10)};
    std::array<Texel, 3> corners;
    for (Texel& corner : corners) {
      corner = {place.x + between(-reach, reach), place.y + between(-reach, reach)};
      if (i % 4 == 0) corner = {std::round(corner.x) + 0.5, std::round(corner.y) + 0.5};
    }
    if (i % 10 == 1) corners[2] = corners[1];
    if (i % 10 == 3) corners[2] = {(corners[0].x + corners[1].x) / 2, corners[0].y};
    atlas.face(slot, corners, static_cast<std::uint32_t>(random() % 6));
  }
}

/// Slots smaller than a tile, larger, of one row or column only, shifted, and without a size.
Atlas random_atlas(std::uint32_t seed) {
  Atlas atlas;
  atlas.slot(100, 70);
  atlas.slot_without_size();
  atlas.slot(33, 120, 3, -2);
  atlas.slot(8, 8);
  atlas.slot(1, 90);
  atlas.slot(64, 1);
  atlas.slot(50, 50);
  std::mt19937 random(seed);
  for (const std::uint32_t slot : {0U, 2U, 3U, 4U, 5U}) {
    for (const double reach : {0.4, 3.0, 20.0, 300.0, 1e6, 0x1p29}) {
      add_random_faces(atlas, slot, 12, reach, random);
    }
  }
  return atlas;
}

/// Parameters: side of tiles, KiB of budget, workers.
class AtlasRasterTest
    : public testing::TestWithParam<std::tuple<std::int64_t, std::uint64_t, std::size_t>> {
 protected:
  Knobs knobs() const {
    return {std::get<0>(GetParam()), std::get<1>(GetParam()) << 10, std::get<2>(GetParam())};
  }
};
INSTANTIATE_TEST_SUITE_P(TilesBudgetsAndWorkers, AtlasRasterTest,
                         testing::Combine(testing::Values(1, 7, 16, 64),
                                          testing::Values(384, 16384), testing::Values(1, 3)));

TEST_P(AtlasRasterTest, RandomTrianglesAreThoseOfWholeLevels) {
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_whole_levels(random_atlas(seed), knobs());
  }
}

/// More than fit in the memory of a worker of kLittle.
constexpr std::size_t kManyFaces = 6000;
constexpr Knobs kLittle{.tile_size = 32, .budget_bytes = 192 << 10, .workers = 3};

TEST(AtlasRasterTest, SlotOfOneTileWithMoreTrianglesThanMemory) {
  Atlas atlas;
  atlas.slot(32, 20);
  std::mt19937 random(1);
  add_random_faces(atlas, 0, kManyFaces, 4, random);
  expect_whole_levels(atlas, kLittle);
  EXPECT_EQ(draw(atlas, kLittle).work.tiles, 1U);
}

TEST(AtlasRasterTest, TileWithMoreTrianglesThanMemory) {
  Atlas atlas;
  atlas.slot(90, 40);
  std::mt19937 random(2);
  for (std::size_t i = 0; i < kManyFaces; ++i) {
    const double x = 12 + 1e-3 * static_cast<double>(i % 1000);
    atlas.face(0, {{{x, 20}, {x + 3, 21}, {x + 1, 24}}}, static_cast<std::uint32_t>(i % 3));
  }
  add_random_faces(atlas, 0, 100, 30, random);
  expect_whole_levels(atlas, kLittle);
  EXPECT_GT(draw(atlas, kLittle).work.tiles, 4U);
}

TEST(AtlasRasterTest, EveryTileWithMoreTrianglesThanMemory) {
  Atlas atlas;
  atlas.slot(64, 64);
  for (std::size_t i = 0; i < kManyFaces; ++i) {
    atlas.full_face(0, static_cast<std::uint32_t>(i % 2));
  }
  for (const TextureLevel& level : draw(atlas, kLittle).levels) {
    const std::uint64_t texels = level.width * level.height;
    EXPECT_EQ(level.counts.covered, texels);
    EXPECT_EQ(level.counts.drawn, texels * kManyFaces);
    EXPECT_EQ(level.counts.lost, texels * (kManyFaces - 1));
    EXPECT_EQ(level.counts.overlaps_between, texels);
    EXPECT_EQ(level.counts.clashes, 0U) << "all texels are of the higher chart";
  }
}

TEST(AtlasRasterTest, LargeSlotsOfFewTriangles) {
  Atlas atlas;
  std::mt19937 random(3);
  for (std::uint32_t slot = 0; slot < 40; ++slot) {
    atlas.slot(65 + slot, 120 - slot);
    add_random_faces(atlas, slot, 1 + slot % 3, 20, random);
  }
  expect_whole_levels(atlas, kLittle);
}

TEST(AtlasRasterTest, ThousandsOfSmallSlots) {
  Atlas atlas;
  constexpr std::uint32_t kSlots = 5000;
  for (std::uint32_t slot = 0; slot < kSlots; ++slot) atlas.slot(4, 4);
  for (std::uint32_t slot = kSlots; slot-- > 0;) atlas.full_face(slot, slot);
  const Drawn drawn = draw(atlas, kLittle);
  ASSERT_EQ(drawn.levels.size(), 3 * kSlots);
  for (std::uint32_t i = 0; i < 3 * kSlots; ++i) {
    ASSERT_EQ(raw(drawn.levels[i].slot), i / 3);
    ASSERT_EQ(drawn.levels[i].level, i % 3);
    ASSERT_EQ(drawn.levels[i].counts.drawn, (std::array{16U, 4U, 1U})[i % 3]);
  }
  EXPECT_EQ(drawn.work.tiles, kSlots);
}

TEST(AtlasRasterTest, SlotsWithoutFacesHaveLevelsOfZeros) {
  Atlas atlas;
  atlas.slot(40, 12);
  atlas.slot(8, 8);
  const Drawn drawn = draw(atlas, kLittle);
  ASSERT_EQ(drawn.levels.size(), 8U);
  for (const TextureLevel& level : drawn.levels) EXPECT_EQ(level.counts, TexelCounts{});
  EXPECT_EQ(drawn.levels[1].width, 20U);
  EXPECT_EQ(drawn.levels[1].height, 6U);
  EXPECT_EQ(drawn.work.tiles, 0U);
}

TEST(AtlasRasterTest, SlotsWithoutASizeHaveNoLevels) {
  Atlas atlas;
  atlas.slot_without_size();
  EXPECT_TRUE(draw(atlas, kLittle).levels.empty());
}

TEST(AtlasRasterTest, FarFacesAreNotDrawn) {
  Atlas atlas;
  atlas.slot(8, 8);
  atlas.face(0, {{{0, 0}, {16, 0}, {0, 16}}}, 0, false);
  EXPECT_EQ(draw(atlas, kLittle).levels[0].counts.drawn, 0U);
}

TEST(AtlasRasterTest, LargestChartNumbersDiffer) {
  constexpr std::uint32_t kLast = (std::uint32_t{1} << 30) - 1;
  Atlas atlas;
  atlas.slot(64, 4);
  atlas.face(0, {{{0, 0}, {32, 0}, {32, 4}}}, kLast);
  atlas.face(0, {{{0, 0}, {32, 4}, {0, 4}}}, kLast);
  atlas.face(0, {{{32, 0}, {64, 0}, {64, 4}}}, kLast - 1);
  atlas.face(0, {{{32, 0}, {64, 4}, {32, 4}}}, kLast - 1);
  const Drawn drawn = draw(atlas, kLittle);
  EXPECT_EQ(drawn.levels[0].counts.clashes, 8U) << "across the border of two tiles";
  EXPECT_EQ(drawn.levels[0].counts.overlaps_between, 0U);
}

TEST(AtlasRasterTest, TalliesATriangleOnceForEachTileOfEachLevel) {
  Atlas atlas;
  atlas.slot(64, 64);
  atlas.full_face(0);
  const Drawn drawn = draw(atlas, kLittle);
  EXPECT_EQ(drawn.work.tiles, 4U + 1) << "four of level 0, one of all smaller levels";
  EXPECT_EQ(drawn.work.triangles.scalar, 4U + 6) << "levels of 32, 16, 8, 4, 2 and 1";
  EXPECT_EQ(drawn.work.triangles.osmesa, 0U);
}

TEST(AtlasRasterTest, SizeOfTilesIsTheOneAskedFor) {
  Atlas atlas;
  atlas.slot(100, 100);
  EXPECT_EQ(draw(atlas, {.tile_size = 7}).work.tile_size, 7);
}

TEST(AtlasRasterTest, AllWorkersDraw) {
  Atlas atlas;
  atlas.slot(640, 640);
  std::mt19937 random(4);
  add_random_faces(atlas, 0, 20'000, 30, random);
  EXPECT_GE(draw(atlas, {.budget_bytes = 1 << 20}).workers_busy, 2U);
}

}  // namespace
}  // namespace atlasgauge
