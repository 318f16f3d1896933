// The oracle's texel counts, worked out by hand.

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/oracle/oracle.hpp"

namespace atlasgauge {
namespace {

using nlohmann::json;
using oracle::Size;

constexpr Size kFour = {4, 4};

/// Corners in texels of a texture; equal ones of one chart are one vertex.
struct Drawn {
  std::array<std::array<double, 2>, 3> corners;
  int chart = 0;
};

using Drawing = std::vector<Drawn>;

/// The vertex of a corner lies above its place on the texture, at the height of its chart.
oracle::Model model_of(Size size, const Drawing& triangles) {
  oracle::Model model;
  model.slots.push_back({"N/A", "", size, {}});
  for (const Drawn& triangle : triangles) {
    oracle::Face face;
    face.slot = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [x, y] = triangle.corners[k];
      face.vertices[k] = static_cast<std::int64_t>(model.positions.size());
      model.positions.push_back({x, y, static_cast<double>(triangle.chart)});
      face.uvs[k] = {static_cast<float>(x / size.first), static_cast<float>(y / size.second)};
    }
    model.faces.push_back(face);
  }
  return model;
}

json report_of(Size size, const Drawing& triangles) {
  return oracle::measure(model_of(size, triangles));
}

Drawing rectangle(double x0, double y0, double x1, double y1, int chart = 0) {
  return {{{{{x0, y0}, {x1, y0}, {x1, y1}}}, chart}, {{{{x0, y0}, {x1, y1}, {x0, y1}}}, chart}};
}

Drawing operator+(Drawing a, const Drawing& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const Drawing kLowerLeft = {{{{{0, 0}, {4, 0}, {0, 4}}}}};
const Drawing kUpperRight = {{{{{4, 0}, {4, 4}, {0, 4}}}}};

/// One number of every level.
std::vector<std::int64_t> by_level(const json& report, const std::string& key) {
  std::vector<std::int64_t> numbers;
  for (const json& level : report.at("texture_0")) numbers.push_back(level.at(key));
  return numbers;
}

using Numbers = std::vector<std::int64_t>;

TEST(OracleRasterTest, RightTriangleLeavesItsDiagonalOut) {
  const json report = report_of(kFour, kLowerLeft);
  EXPECT_EQ(by_level(report, "rw"), (Numbers{4, 2, 1}));
  EXPECT_EQ(by_level(report, "rh"), (Numbers{4, 2, 1}));
  EXPECT_EQ(by_level(report, "totalTexels"), (Numbers{6, 1, 0}));
  EXPECT_EQ(by_level(report, "totalTexels_bilinear"), (Numbers{13, 4, 0}));
  EXPECT_EQ(by_level(report, "boundaryTexels"), (Numbers{6, 1, 0}));
  EXPECT_EQ(by_level(report, "overwrittenTexels"), (Numbers{0, 0, 0}));
  EXPECT_EQ(by_level(report, "lostTexels"), (Numbers{0, 0, 0}));
  EXPECT_EQ(by_level(report, "texelClashes"), (Numbers{0, 0, 0}));
  EXPECT_EQ(report.at("occupancy"), 6.0 / 16);
}

TEST(OracleRasterTest, LeftDiagonalIsInside) {
  const json report = report_of(kFour, kUpperRight);
  EXPECT_EQ(by_level(report, "totalTexels"), (Numbers{10, 3, 1}));
}

TEST(OracleRasterTest, LowerSideIsInsideAndUpperSideIsNot) {
  const json report = report_of(kFour, rectangle(0, 0.5, 4, 2.5));
  EXPECT_EQ(by_level(report, "totalTexels").front(), 8);
  EXPECT_EQ(by_level(report_of(kFour, rectangle(0, 0.5, 4, 0.75)), "totalTexels").front(), 4);
  EXPECT_EQ(by_level(report_of(kFour, rectangle(0, 0.25, 4, 0.5)), "totalTexels").front(), 0);
}

TEST(OracleRasterTest, LeftSideIsInsideAndRightSideIsNot) {
  EXPECT_EQ(by_level(report_of(kFour, rectangle(0.5, 0, 0.75, 4)), "totalTexels").front(), 4);
  EXPECT_EQ(by_level(report_of(kFour, rectangle(0.25, 0, 0.5, 4)), "totalTexels").front(), 0);
}

TEST(OracleRasterTest, SharedDiagonalThroughCentresIsHitOnce) {
  for (const Drawing& quad : {rectangle(0, 0, 4, 4), kLowerLeft + kUpperRight}) {
    const json report = report_of(kFour, quad);
    EXPECT_EQ(by_level(report, "totalTexels"), (Numbers{16, 4, 1}));
    EXPECT_EQ(by_level(report, "overwrittenTexels"), (Numbers{0, 0, 0}));
    EXPECT_EQ(by_level(report, "boundaryTexels"), (Numbers{12, 4, 1}));
    EXPECT_EQ(report.at("occupancy"), 1.0);
  }
}

TEST(OracleRasterTest, FanAroundACentreHitsItOnce) {
  Drawing fan;
  const std::vector<std::array<double, 2>> ring = {{0, 1}, {1.5, 0}, {4, 2}, {3, 4}, {0.5, 3}};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    fan.push_back({{{{1.5, 1.5}, ring[i], ring[(i + 1) % ring.size()]}}});
  }
  EXPECT_EQ(by_level(report_of(kFour, fan), "overwrittenTexels").front(), 0);
  EXPECT_EQ(by_level(report_of(kFour, {{{{{1.5, 1.5}, {4, 0}, {4, 4}}}},
                                       {{{{1.5, 1.5}, {4, 4}, {0, 4}}}},
                                       {{{{1.5, 1.5}, {0, 4}, {0, 0}}}},
                                       {{{{1.5, 1.5}, {0, 0}, {4, 0}}}}}),
                     "totalTexels")
                .front(),
            16);
}

TEST(OracleRasterTest, MirroredTriangleCoversTheSame) {
  const Drawing mirrored = {{{{{0, 0}, {0, 4}, {4, 0}}}}};
  EXPECT_EQ(report_of(kFour, mirrored).at("texture_0"),
            report_of(kFour, kLowerLeft).at("texture_0"));
}

TEST(OracleRasterTest, RepeatsOfOneChartOverlapWithinIt) {
  const json report = report_of(kFour, kLowerLeft + kLowerLeft + kLowerLeft);
  EXPECT_EQ(by_level(report, "totalTexels"), (Numbers{18, 3, 0}));
  EXPECT_EQ(by_level(report, "overwrittenTexels"), (Numbers{6, 1, 0}));
  EXPECT_EQ(by_level(report, "lostTexels"), (Numbers{12, 2, 0}));
  EXPECT_EQ(by_level(report, "texelClashes"), (Numbers{0, 0, 0}));
  EXPECT_EQ(report.at("overlap_within_chart_texels"), 6);
  EXPECT_EQ(report.at("overlap_between_charts_texels"), 0);
  EXPECT_EQ(report.at("occupancy"), 6.0 / 16);
}

TEST(OracleRasterTest, TexelOfTwoChartsOverlapsBetweenThemOnly) {
  const json report =
      report_of(kFour, kLowerLeft + kLowerLeft + rectangle(0, 0, 1, 1, 1) + rectangle(3, 3, 4, 4));
  EXPECT_EQ(by_level(report, "totalTexels").front(), 14);
  EXPECT_EQ(by_level(report, "overwrittenTexels").front(), 6);
  EXPECT_EQ(by_level(report, "lostTexels").front(), 7);
  EXPECT_EQ(report.at("overlap_within_chart_texels"), 5);
  EXPECT_EQ(report.at("overlap_between_charts_texels"), 1);
}

TEST(OracleRasterTest, ChartsSideBySideClash) {
  const json report = report_of(kFour, rectangle(0, 0, 2, 4, 0) + rectangle(2, 0, 4, 4, 1));
  EXPECT_EQ(by_level(report, "texelClashes"), (Numbers{8, 4, 0}));
  EXPECT_EQ(by_level(report, "totalTexels"), (Numbers{16, 4, 1}));
}

TEST(OracleRasterTest, ChartsClashAcrossACorner) {
  const json report = report_of(kFour, rectangle(0, 0, 1, 1, 0) + rectangle(1, 1, 2, 2, 1));
  EXPECT_EQ(by_level(report, "texelClashes").front(), 2);
}

TEST(OracleRasterTest, ChartsATexelApartDoNotClash) {
  const json report = report_of(kFour, rectangle(0, 0, 1, 4, 0) + rectangle(2, 0, 4, 4, 1));
  EXPECT_EQ(by_level(report, "texelClashes").front(), 0);
}

TEST(OracleRasterTest, SharedTexelBelongsToTheHighestChart) {
  const json low_below = report_of(kFour, rectangle(0, 0, 4, 4, 0) + rectangle(0, 0, 1, 4, 1));
  const json high_below = report_of(kFour, rectangle(0, 0, 1, 4, 0) + rectangle(0, 0, 4, 4, 1));
  EXPECT_EQ(by_level(low_below, "texelClashes").front(), 8);
  EXPECT_EQ(by_level(high_below, "texelClashes").front(), 0);
}

TEST(OracleRasterTest, SizesHalveWithFloorUntilASideIsGone) {
  const json report = report_of({5, 3}, rectangle(0, 0, 5, 3));
  EXPECT_EQ(by_level(report, "rw"), (Numbers{5, 2}));
  EXPECT_EQ(by_level(report, "rh"), (Numbers{3, 1}));
  EXPECT_EQ(by_level(report, "totalTexels"), (Numbers{15, 2}));
  EXPECT_EQ(by_level(report_of({1, 9}, rectangle(0, 0, 1, 9)), "rh"), (Numbers{9}));
}

TEST(OracleRasterTest, RimIsBoundary) {
  const json report = report_of({5, 3}, rectangle(0, 0, 5, 3));
  EXPECT_EQ(by_level(report, "boundaryTexels"), (Numbers{12, 2}));
}

TEST(OracleRasterTest, BareCornerNeighbourMakesABoundary) {
  const Drawing all_but_a_corner = rectangle(0, 0, 5, 4) + rectangle(0, 4, 4, 5);
  EXPECT_EQ(by_level(report_of({5, 5}, all_but_a_corner), "boundaryTexels").front(), 15 + 1);
}

TEST(OracleRasterTest, BilinearReachesOneTexelFurther) {
  EXPECT_EQ(by_level(report_of({5, 5}, rectangle(2, 2, 3, 3)), "totalTexels_bilinear").front(), 9);
  EXPECT_EQ(by_level(report_of({5, 5}, rectangle(4, 4, 5, 5)), "totalTexels_bilinear").front(), 4);
  EXPECT_EQ(by_level(report_of({5, 5}, rectangle(2, 2, 3, 3) + rectangle(4, 2, 5, 3)),
                     "totalTexels_bilinear")
                .front(),
            12);
}

TEST(OracleRasterTest, CornersSnapToTheNearestUnitAndHalvesToEvenOnes) {
  constexpr double kHalfUnit = 1.0 / 512;
  const auto covered = [](double left) {
    return by_level(report_of(kFour, rectangle(left, 0, 1, 1)), "totalTexels").front();
  };
  EXPECT_EQ(covered(0.5 + kHalfUnit), 1);
  EXPECT_EQ(covered(0.5 + 0.75 * kHalfUnit), 1);
  EXPECT_EQ(covered(0.5 + 1.5 * kHalfUnit), 0);
  EXPECT_EQ(covered(0.5 + 2 * kHalfUnit), 0);
  EXPECT_EQ(covered(0.5 + 3 * kHalfUnit), 0);
}

TEST(OracleRasterTest, WideTextureIsFourTexelsWideWhenOneHigh) {
  const json report = report_of({8, 2}, rectangle(0, 0, 4, 2));
  EXPECT_EQ(by_level(report, "totalTexels"), (Numbers{8, 2}));
}

TEST(OracleRasterTest, LevelsSnapForThemselves) {
  const json report = report_of({2, 2}, rectangle(0, 0, 1 + 1.0 / 512, 2));
  EXPECT_EQ(by_level(report, "totalTexels"), (Numbers{2, 0}));
  EXPECT_EQ(by_level(report_of({2, 2}, rectangle(0, 0, 1 + 4.0 / 512, 2)), "totalTexels"),
            (Numbers{2, 1}));
}

TEST(OracleRasterTest, TriangleThatSnapsToALineCoversNothing) {
  const json report = report_of(kFour, {{{{{0, 0.5}, {4, 0.5}, {4, 0.5 + 1.0 / 1024}}}}});
  EXPECT_GT(report.at("area_uv"), 0.0);
  EXPECT_EQ(by_level(report, "totalTexels"), (Numbers{0, 0, 0}));
  EXPECT_TRUE(report.at("occupancy").is_null());
  EXPECT_EQ(report.at("overlap_within_chart_texels"), 0);
  EXPECT_EQ(report.at("sf_avg"), 1.0);
}

TEST(OracleRasterTest, WhatLiesOutsideIsClipped) {
  const json report = report_of(kFour, rectangle(-16, -16, 20, 20));
  EXPECT_EQ(by_level(report, "totalTexels"), (Numbers{16, 4, 1}));
  EXPECT_EQ(by_level(report, "overwrittenTexels"), (Numbers{0, 0, 0}));
}

TEST(OracleRasterTest, WholeTextureIsShiftedByIntegers) {
  const json here = report_of(kFour, kLowerLeft);
  const json shifted = report_of(kFour, {{{{{-8, 12}, {-4, 12}, {-8, 16}}}}});
  EXPECT_EQ(shifted.at("texture_0"), here.at("texture_0"));
}

TEST(OracleRasterTest, TriangleOfTheLargestSizeIsDrawnAndALargerOneIsNot) {
  const double far = 0x1p30;
  const auto triangle = [&](double top) {
    return Drawing{{{{{-far, -far}, {far, -far}, {0, top}}}}};
  };
  const json drawn = report_of(kFour, triangle(far));
  EXPECT_EQ(drawn.at("uv_far"), 0);
  EXPECT_EQ(by_level(drawn, "totalTexels"), (Numbers{16, 4, 1}));
  const json left_out = report_of(kFour, triangle(far + 256));
  EXPECT_EQ(left_out.at("uv_far"), 1);
  EXPECT_EQ(by_level(left_out, "totalTexels"), (Numbers{0, 0, 0}));
}

TEST(OracleRasterTest, OnlyFacesOfTheWeldedLevelAreDrawn) {
  oracle::Model model = model_of(kFour, kLowerLeft);
  model.positions[1] = model.positions[0];
  EXPECT_EQ(by_level(oracle::measure(model), "totalTexels"), (Numbers{0, 0, 0}));
}

TEST(OracleRasterTest, FaceIsDrawnOnItsOwnSlotOnly) {
  oracle::Model model = model_of(kFour, kLowerLeft);
  model.slots.push_back({"other", "", Size{2, 2}, {}});
  model.slots.push_back({"missing", "", std::nullopt, {}});
  const json report = oracle::measure(model);
  EXPECT_EQ(report.at("texture_1").at(0).at("totalTexels"), 0);
  EXPECT_EQ(report.at("texture_2"), json::array());
  EXPECT_EQ(report.at("occupancy"), 6.0 / 16);
}

TEST(OracleRasterTest, UnitSlotCountsNoTexels) {
  oracle::Model model = model_of({1, 1}, rectangle(0, 0, 1, 1));
  model.counts_texels = false;
  const json report = oracle::measure(model);
  const json level = {{"rw", 1},
                      {"rh", 1},
                      {"totalTexels", nullptr},
                      {"totalTexels_bilinear", nullptr},
                      {"overwrittenTexels", nullptr},
                      {"lostTexels", nullptr},
                      {"boundaryTexels", nullptr},
                      {"texelClashes", nullptr}};
  EXPECT_EQ(report.at("texture_0"), json::array({level}));
  for (const char* key :
       {"occupancy", "overlap_within_chart_texels", "overlap_between_charts_texels"}) {
    EXPECT_TRUE(report.at(key).is_null()) << key;
  }
  EXPECT_EQ(report.at("texel_density_avg"), 1.0);
}

/// A full texture of two triangles, of 8 square texels and of 3D areas 199/2 and `small`/2.
oracle::Model unequal_halves(double small) {
  oracle::Model model = model_of(kFour, rectangle(0, 0, 4, 4));
  model.positions = {{0, 0, 0}, {199, 0, 0}, {0, 1, 0}, {0, 0, 9}, {small, 0, 9}, {0, 1, 9}};
  return model;
}

TEST(OracleScaleTest, FaceBeyondAHundredTimesItsShareIsCut) {
  // The bound is 100 · (1 / 200) · 16 = 8 square texels.
  const json at_the_bound = oracle::measure(unequal_halves(1));
  EXPECT_EQ(at_the_bound.at("sf_discardedArea"), 0.0);
  EXPECT_GT(at_the_bound.at("sf_max"), 90.0);
  const json beyond = oracle::measure(unequal_halves(0.99));
  EXPECT_EQ(beyond.at("sf_discardedArea"), 0.99 / 2);
  EXPECT_EQ(beyond.at("sf_max"), 1.0);
  EXPECT_EQ(beyond.at("sf_untrimmed_avg"), 1.0);
}

TEST(OracleScaleTest, BoundCountsTheTexelsOfUnusedSlots) {
  oracle::Model model = unequal_halves(0.99);
  model.slots.push_back({"unused", "", kFour, {}});
  EXPECT_EQ(oracle::measure(model).at("sf_discardedArea"), 0.0);
  EXPECT_EQ(oracle::measure(model).at("occupancy"), 1.0);
}

TEST(OracleScaleTest, NothingIsCutWithoutOccupancy) {
  oracle::Model model = unequal_halves(0.99);
  model.counts_texels = false;
  EXPECT_EQ(oracle::measure(model).at("sf_discardedArea"), 0.0);
  EXPECT_GT(oracle::measure(model).at("sf_max"), 90.0);
}

TEST(OracleScaleTest, StatisticsOverNoFaceAreNull) {
  oracle::Model model = model_of(kFour, kLowerLeft);
  model.faces[0].uvs[0].reset();
  const json report = oracle::measure(model);
  EXPECT_TRUE(report.at("sf_avg").is_null());
  EXPECT_EQ(report.at("sf_discardedArea"), 0.0);
}

}  // namespace
}  // namespace atlasgauge
