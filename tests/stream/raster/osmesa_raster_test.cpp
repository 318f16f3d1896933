#include "stream/raster/osmesa_raster.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <memory>
#include <random>
#include <span>
#include <thread>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "stream/raster/osmesa_module.hpp"
#include "stream/raster/scalar_raster.hpp"
#include "tests/support/module_folder.hpp"
#include "tests/support/raster_scene.hpp"

/// Asked by the leak checker of the address sanitizer: OSMesa never frees the picture of its own
/// that a context is made with.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libOSMesa";
}

namespace atlasgauge {
namespace {

using Triangles = std::vector<SnappedTriangle>;

/// Times as many triangles, for a million of them.
std::size_t thoroughness() {
  return std::getenv("ATLASGAUGE_THOROUGH") != nullptr ? 400 : 1;
}

std::ptrdiff_t threads() {
  namespace fs = std::filesystem;
  return std::distance(fs::directory_iterator("/proc/self/task"), fs::directory_iterator());
}

class OsmesaRasterTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    show_modules(kOsmesaModuleFile);
    threads_before_ = threads();
    raster_ = make_osmesa_raster();
  }
  static void TearDownTestSuite() { raster_.reset(); }

  /// That it draws what the scalar raster draws, into as many triangles. Returns its own tally.
  static RasterTally expect_as_scalar(std::span<const SnappedTriangle> triangles,
                                      const TexelRect& rect, const LevelSize& level) {
    const RasterTally before = raster_->tally();
    TexelTile drawn = tile_of(rect, level);
    raster_->draw(triangles, drawn);
    ScalarRaster scalar;
    TexelTile expected = tile_of(rect, level);
    scalar.draw(triangles, expected);
    expect_equal(drawn, expected);
    const RasterTally tally{raster_->tally().scalar - before.scalar,
                            raster_->tally().osmesa - before.osmesa};
    EXPECT_EQ(tally.scalar + tally.osmesa, scalar.tally().scalar);
    return tally;
  }

  static std::unique_ptr<Raster> raster_;
  static std::ptrdiff_t threads_before_;
};

std::unique_ptr<Raster> OsmesaRasterTest::raster_;
std::ptrdiff_t OsmesaRasterTest::threads_before_ = 0;

/// How triangles lie about a tile.
struct Scatter {
  TexelRect about;
  double least_texels, most_texels;  // size of a triangle, log-uniform
  std::int64_t step;                 // of the lattice of vertices
  std::uint32_t charts;
};

SnappedTriangle scattered(std::mt19937& random, const Scatter& scatter) {
  std::uniform_real_distribution<double> unit(0, 1);
  const double size =
      scatter.least_texels * std::pow(scatter.most_texels / scatter.least_texels, unit(random));
  const auto within = [&](std::int64_t from, std::int64_t to) {
    return static_cast<double>(from - 2) + unit(random) * static_cast<double>(to - from + 4);
  };
  const double x = within(scatter.about.x0, scatter.about.x1);
  const double y = within(scatter.about.y0, scatter.about.y1);
  const auto corner = [&](double centre) {
    return snap(centre + (unit(random) - 0.5) * size) / scatter.step * scatter.step;
  };
  SnappedTriangle t;
  for (int k = 0; k < 3; ++k) {
    t.x[k] = corner(x);
    t.y[k] = corner(y);
  }
  t.chart = static_cast<std::uint32_t>(unit(random) * scatter.charts);
  return t;
}

Triangles scattered(std::mt19937& random, const Scatter& scatter, std::size_t count) {
  Triangles triangles;
  std::generate_n(std::back_inserter(triangles), count, [&] { return scattered(random, scatter); });
  return triangles;
}

/// A tile in the lower left, in the middle and in the upper right of a level; smaller levels whole.
std::vector<TexelRect> tiles_of(std::int64_t level, std::int64_t side) {
  if (level <= side) return {{0, 0, level, level}};
  const std::int64_t middle = level / 2 / side * side;
  const std::int64_t last = (level - 1) / side * side;
  return {{0, 0, side, side},
          {middle, middle, std::min(level, middle + side), std::min(level, middle + side)},
          {last, last, level, level}};
}

TEST_F(OsmesaRasterTest, AgreesWithTheHalfSpaceRule) {
  std::mt19937 random(1);
  for (const std::int64_t reach : {40, 300, 2000, 20000, 200000}) {
    for (const std::int64_t step : {1, 128, 256}) {
      SCOPED_TRACE(testing::Message() << "reach " << reach << ", step " << step);
      const Triangles triangles = random_triangles(random, 150, 60, reach, step);
      TexelTile drawn = tile_of({16, 8, 32, 24}, {60, 33});
      raster_->draw(triangles, drawn);
      TexelTile naive = tile_of({16, 8, 32, 24}, {60, 33});
      draw_naively(triangles, naive);
      expect_equal(drawn, naive);
    }
  }
}

TEST_F(OsmesaRasterTest, AgreesWithTheScalarRasterOnLevelsOfAnySize) {
  std::mt19937 random(2);
  RasterTally sum;
  const auto draw = [&](const Scatter& scatter, std::size_t count, std::int64_t level) {
    const RasterTally tally =
        expect_as_scalar(scattered(random, scatter, count), scatter.about, {level, level});
    sum.scalar += tally.scalar;
    sum.osmesa += tally.osmesa;
  };
  for (const std::int64_t level : {1, 2, 255, 256, 2000, 4096, 16384}) {
    for (const TexelRect& rect : tiles_of(level, 1000)) {
      for (const std::int64_t step : {1, 128, 256}) {
        SCOPED_TRACE(testing::Message()
                     << "level " << level << " at " << rect.x0 << ", step " << step);
        const std::uint32_t charts = step == 1 ? 1000000 : 3;
        const std::size_t count = 25 * thoroughness();
        draw({rect, 0.1, 30, step, charts}, 4 * count, level);
        draw({rect, 30, 3000, step, charts}, count, level);
      }
    }
  }
  EXPECT_GT(sum.osmesa, 2500 * thoroughness());
  EXPECT_EQ(sum.scalar, 0U);
}

TEST_F(OsmesaRasterTest, AgreesWhereTrianglesCrowd) {
  std::mt19937 random(3);
  const Scatter crowd{{2500, 1200, 2510, 1203}, 0.01, 20, 1, 50};
  expect_as_scalar(scattered(random, crowd, 5000), {2048, 1024, 2560, 1300}, {5000, 1300});
}

/// A grid of quads, two triangles each, whose inner vertices are moved by up to `jitter`. Corners
/// of the grid lie on those of texels, and four quads on a texel.
Triangles jittered_grid(std::mt19937& random, std::int64_t quads, std::int64_t jitter) {
  std::uniform_int_distribution<std::int64_t> offset(-jitter, jitter);
  const auto side = static_cast<std::size_t>(quads + 1);
  std::vector<std::int64_t> x, y;
  for (std::int64_t row = 0; row <= quads; ++row) {
    for (std::int64_t column = 0; column <= quads; ++column) {
      const bool inner_x = column > 0 && column<quads, inner_y = row> 0 && row < quads;
      x.push_back(128 * column + (inner_x ? offset(random) : 0));
      y.push_back(128 * row + (inner_y ? offset(random) : 0));
    }
  }
  Triangles triangles;
  const auto add = [&](std::size_t a, std::size_t b, std::size_t c) {
    const auto chart = static_cast<std::uint32_t>(triangles.size() / 500);
    triangles.push_back({{x[a], x[b], x[c]}, {y[a], y[b], y[c]}, chart});
  };
  for (std::size_t row = 0; row + 1 < side; ++row) {
    for (std::size_t column = 0; column + 1 < side; ++column) {
      const std::size_t at = row * side + column;
      add(at, at + 1, at + side + 1);
      add(at, at + side + 1, at + side);
    }
  }
  return triangles;
}

TEST_F(OsmesaRasterTest, MeshesCoverEveryTexelOnce) {
  std::mt19937 random(4);
  for (const std::int64_t jitter : {0, 1, 40}) {
    SCOPED_TRACE(jitter);
    const Triangles mesh = jittered_grid(random, 100, jitter);
    TexelTile tile = tile_of({0, 0, 50, 50}, {50, 50});
    raster_->draw(mesh, tile);
    for (std::int64_t y = 0; y < 50; ++y) {
      for (std::int64_t x = 0; x < 50; ++x) ASSERT_EQ(tile.counts()[tile.index(x, y)], 1U);
    }
    expect_as_scalar(mesh, {0, 0, 50, 50}, {50, 50});
  }
}

TEST_F(OsmesaRasterTest, MeshesOfManySizesAgree) {
  std::mt19937 random(5);
  for (const std::int64_t scale : {1, 3, 16, 77}) {
    Triangles mesh = jittered_grid(random, 100, 60);
    for (SnappedTriangle& t : mesh) {
      for (int k = 0; k < 3; ++k) {
        t.x[k] = t.x[k] * scale + 11;
        t.y[k] = t.y[k] * scale - 300;
      }
    }
    expect_as_scalar(mesh, {64, 64, 320, 320}, {2000, 2000});
  }
}

TEST_F(OsmesaRasterTest, DegenerateTrianglesCoverNothing) {
  TexelTile tile = tile_of({0, 0, 8, 8}, {8, 8});
  raster_->draw(
      std::vector{triangle({0.5, 0.5}, {6.5, 6.5}, {3.5, 3.5}), triangle({1, 2}, {1, 2}, {1, 2}),
                  triangle({0.5, 2.5}, {7.5, 2.5}, {3.5, 2.5}),
                  triangle({2.5, 0}, {2.5, 9}, {2.5, 4})},
      tile);
  EXPECT_EQ(covered_texels(tile), 0U);
}

TEST_F(OsmesaRasterTest, BothOrientationsCount) {
  TexelTile tile = tile_of({0, 0, 1, 1}, {1, 1});
  raster_->draw(std::vector{triangle({0, 0}, {4, 0}, {0, 4}), triangle({0, 0}, {0, 4}, {4, 0})},
                tile);
  EXPECT_EQ(tile.counts()[tile.index(0, 0)], 2U);
}

TEST_F(OsmesaRasterTest, NeighbouringChartNumbersBeyondTheFloatsDiffer) {
  TexelTile tile = tile_of({0, 0, 2, 1}, {2, 1});
  const std::uint32_t last = (std::uint32_t{1} << 30) - 1;
  raster_->draw(std::vector{triangle({0, 0}, {4, 0}, {0, 4}, last - 1),
                            triangle({0, 0}, {0, 2}, {2, 1}, last),
                            triangle({1, 0}, {2, 0}, {1, 1}, last - 1)},
                tile);
  EXPECT_EQ(tile.charts()[tile.index(0, 0)], last + 1);
  EXPECT_EQ(tile.counts()[tile.index(0, 0)], 2U | TexelTile::kSeveralCharts);
  EXPECT_EQ(tile.charts()[tile.index(1, 0)], last);
}

TEST_F(OsmesaRasterTest, DrawsOnTopOfWhatWasDrawn) {
  std::mt19937 random(6);
  const TexelRect rect{3, 5, 60, 40};
  TexelTile drawn = tile_of(rect, {64, 64}), expected = drawn;
  for (int time = 0; time < 5; ++time) {
    const Triangles triangles = scattered(random, {rect, 1, 60, 1, 4}, 50);
    raster_->draw(triangles, drawn);
    ScalarRaster().draw(triangles, expected);
  }
  expect_equal(drawn, expected);
}

TEST_F(OsmesaRasterTest, TilesOfAnyShapeFollowEachOther) {
  std::mt19937 random(7);
  for (const TexelRect& rect : std::vector<TexelRect>{{0, 0, 1, 900},
                                                      {5000, 1, 5000 + kMaxOsmesaTile, 2},
                                                      {16, 0, 20, 2},
                                                      {700, 1, 1500, 3}}) {
    SCOPED_TRACE(rect.width());
    expect_as_scalar(scattered(random, {rect, 1, 3000, 1, 100}, 200), rect, {16384, 901});
  }
}

TEST_F(OsmesaRasterTest, TilesThatAreTooLargeAreRefused) {
  TexelTile tile = tile_of({0, 0, kMaxOsmesaTile + 1, 1}, {kMaxOsmesaTile + 1, 1});
  EXPECT_THROW(raster_->draw(std::vector{triangle({0, 0}, {4, 0}, {0, 4})}, tile), Error);
}

TEST_F(OsmesaRasterTest, CountsGoBeyondWhatIsDrawnAtOnce) {
  constexpr std::uint32_t kCount = (std::uint32_t{1} << 20) + 5;
  const Triangles triangles(kCount, triangle({0, 0}, {4, 0}, {0, 4}, 9));
  TexelTile tile = tile_of({0, 0, 1, 1}, {1, 1});
  raster_->draw(triangles, tile);
  EXPECT_EQ(tile.counts()[tile.index(0, 0)], kCount);
}

TEST_F(OsmesaRasterTest, TalliesOnlyTrianglesThatMayTouchTheTile) {
  const RasterTally tally = expect_as_scalar(
      std::vector{triangle({0, 0}, {4, 0}, {0, 4}), triangle({9, 9}, {12, 9}, {9, 12}),
                  triangle({1.6, 1.6}, {2.4, 1.6}, {1.6, 2.4})},
      {0, 0, 4, 4}, {4, 4});
  EXPECT_EQ(tally.osmesa, 1U);
  EXPECT_EQ(tally.scalar, 0U);
}

/// Triangles as large as OSMesa draws, and larger ones.
class GuardBandTest : public OsmesaRasterTest {
 protected:
  static constexpr TexelRect kRect{0, 0, 1000, 600};
  static constexpr LevelSize kLevel{16384, 16384};
  static constexpr std::int64_t kLeft = -256 * OsmesaCanvas::margin(1001);
  static constexpr std::int64_t kRight = kLeft + 256 * OsmesaCanvas::kViewport - 1;
  static constexpr std::int64_t kBottom = -256 * OsmesaCanvas::margin(601);
  static constexpr std::int64_t kTop = kBottom + 256 * OsmesaCanvas::kViewport - 1;

  /// Two corners on the border of the largest rectangle, moved out by `beyond`, one in the tile.
  Triangles reaching(std::int64_t beyond) {
    std::uniform_int_distribution<std::int64_t> x(kLeft, kRight), y(kBottom, kTop);
    std::uniform_int_distribution<std::int64_t> inside(0, 256 * 600);
    Triangles triangles;
    for (int time = 0; time < 20; ++time) {
      const std::int64_t far_x = time % 2 == 0 ? kLeft - beyond : kRight + beyond;
      const std::int64_t far_y = time % 4 < 2 ? kBottom - beyond : kTop + beyond;
      triangles.push_back({{far_x, x(random_), inside(random_)},
                           {y(random_), far_y, inside(random_)},
                           static_cast<std::uint32_t>(time % 3)});
    }
    return triangles;
  }

  std::mt19937 random_{8};
};

TEST_F(GuardBandTest, TrianglesUpToItsBorderAreDrawnByOsmesa) {
  const RasterTally tally = expect_as_scalar(reaching(0), kRect, kLevel);
  EXPECT_EQ(tally.osmesa, 20U);
  EXPECT_EQ(tally.scalar, 0U);
}

/// In any corner of the tile: what the lead of the picture (osmesa_module.cpp) is for.
TEST_F(GuardBandTest, TipsOfLargeTrianglesAreDrawn) {
  std::uniform_int_distribution<std::int64_t> along(0, 256 * 40), far(0, -kBottom);
  Triangles triangles;
  for (std::uint32_t time = 0; time < 2000; ++time) {
    // A corner on each of two sides of the viewport's quarter, the tip in a corner of the tile.
    SnappedTriangle t{{kLeft, kLeft + far(random_), along(random_)},
                      {kBottom + far(random_), kBottom, along(random_)},
                      time};
    for (int k = 0; k < 3; ++k) {
      if (time % 2 == 1) t.x[k] = 256 * kRect.x1 - t.x[k];
      if (time % 4 > 1) t.y[k] = 256 * kRect.y1 - t.y[k];
    }
    triangles.push_back(t);
  }
  const RasterTally tally = expect_as_scalar(triangles, kRect, kLevel);
  EXPECT_GT(tally.osmesa, 1500U);
  EXPECT_LT(tally.scalar, 100U);
}

TEST_F(GuardBandTest, TrianglesBeyondGoToTheScalarRasterAndAreCounted) {
  const RasterTally tally = expect_as_scalar(reaching(1), kRect, kLevel);
  EXPECT_EQ(tally.osmesa, 0U);
  EXPECT_EQ(tally.scalar, 20U);
  Triangles mixed = reaching(0);
  for (const SnappedTriangle& t : reaching(std::int64_t{1} << 37)) mixed.push_back(t);
  const RasterTally both = expect_as_scalar(mixed, kRect, kLevel);
  EXPECT_EQ(both.osmesa, 20U);
  EXPECT_EQ(both.scalar, 20U);
}

TEST_F(OsmesaRasterTest, WorksInTheThreadsOfItsCallers) {
  expect_as_scalar(std::vector{triangle({0, 0}, {900, 0}, {0, 900})}, {0, 0, 999, 999}, {999, 999});
  EXPECT_EQ(threads(), threads_before_);
}

TEST_F(OsmesaRasterTest, RastersOfSeveralThreadsDoNotDisturbEachOther) {
  std::mt19937 random(9);
  const TexelRect rect{0, 0, 300, 300};
  const Triangles triangles = scattered(random, {rect, 0.5, 60, 1, 1000}, 3000);
  TexelTile expected = tile_of(rect, {300, 300});
  ScalarRaster().draw(triangles, expected);
  std::vector<TexelTile> tiles(3, tile_of(rect, {300, 300}));
  std::vector<std::thread> workers;
  for (TexelTile& tile : tiles) {
    // Made in one thread, used in the next, gone in a third.
    std::shared_ptr<Raster> raster = make_osmesa_raster();
    workers.emplace_back([&triangles, &tile, raster = std::move(raster)] {
      for (std::size_t from = 0; from < triangles.size(); from += 100) {
        raster->draw(std::span(triangles).subspan(from, 100), tile);
      }
    });
  }
  for (std::thread& worker : workers) worker.join();
  for (const TexelTile& tile : tiles) expect_equal(tile, expected);
}

}  // namespace
}  // namespace atlasgauge
