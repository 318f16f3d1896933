#include "stream/mesh/chart_runs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "stream/mesh/chart_sum.hpp"

namespace atlasgauge {
namespace {

/// A face with a UV triangle from (0, 0) to (number, number), twice as large in space as in UV.
ChartPart face(std::uint32_t chart, std::uint32_t number, double area_uv, std::uint32_t flags = 0) {
  const std::uint32_t sign =
      area_uv < 0 ? ChartPart::kNegative : (area_uv == 0 ? ChartPart::kNoArea : 0);
  const auto high = static_cast<float>(number);
  return {chart, number | flags, ChartPart::kUvTriangles | sign, 1, 0, 0, high,
          high,  area_uv,        2 * std::abs(area_uv)};
}

std::vector<ChartPart> parts_of(const std::vector<ChartPart>& faces) {
  std::vector<ChartPart> parts;
  const auto push = [&](const ChartPart& part) { parts.push_back(part); };
  ChartRuns runs;
  for (const ChartPart& one : faces) runs.add(one, push);
  runs.end_all(push);
  return parts;
}

Chart chart_of(const std::vector<ChartPart>& parts) {
  ChartSum sum;
  for (const ChartPart& part : parts) sum.add(part);
  return sum.finish(FaceId{0}, SlotFrames({SlotFrame{}}));
}

TEST(ChartRunsTest, FacesOfAChartAreOnePart) {
  const std::vector<ChartPart> parts = parts_of({face(3, 3, 1), face(3, 4, 2), face(3, 9, 4)});
  ASSERT_EQ(parts.size(), 1U);
  EXPECT_EQ(parts[0].chart, 3U);
  EXPECT_EQ(parts[0].faces, 3U);
  EXPECT_EQ(parts[0].area_uv, 7);
  EXPECT_EQ(parts[0].area_3d_or_length, 14);
  EXPECT_EQ(parts[0].low_u, 0);
  EXPECT_EQ(parts[0].high_v, 9);
}

TEST(ChartRunsTest, ChartsThatTakeTurnsAreOnePartEach) {
  const std::vector<ChartPart> parts =
      parts_of({face(0, 0, 1), face(1, 1, 1), face(0, 2, 1), face(1, 3, 1)});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].faces, 2U);
  EXPECT_EQ(parts[1].faces, 2U);
}

TEST(ChartRunsTest, FacesThatAreNotAlikeAreApart) {
  const std::vector<ChartPart> parts =
      parts_of({face(0, 0, 1), face(0, 1, -1), face(0, 2, 1, ChartPart::kFlipped), face(0, 3, 0),
                face(0, 4, 1, ChartPart::kConflict)});
  EXPECT_EQ(parts.size(), 5U);
}

TEST(ChartRunsTest, FacesWithoutAreaFollowOneAnother) {
  const std::vector<ChartPart> parts = parts_of({face(0, 0, 0), face(0, 1, 0), face(0, 3, 0)});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].first_face(), 0U);
  EXPECT_EQ(parts[0].faces, 2U);
  EXPECT_EQ(parts[1].first_face(), 3U);
}

TEST(ChartRunsTest, WhatRoundingTakesIsAPartWithoutFaces) {
  const std::vector<ChartPart> parts = parts_of({face(0, 0, 1), face(0, 1, 0x1p-60)});
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts[0].faces, 2U);
  EXPECT_EQ(parts[0].area_uv, 1);
  EXPECT_EQ(parts[1].faces, 0U);
  EXPECT_EQ(parts[1].area_uv, 0x1p-60);
  EXPECT_EQ(parts[1].area_3d_or_length, 0x1p-59);
}

TEST(ChartRunsTest, ARunEndsWhereItsSumWouldBeRounded) {
  const std::vector<ChartPart> parts =
      parts_of({face(0, 0, 1), face(0, 1, 0x1p-60), face(0, 2, 0x1p-200)});
  ASSERT_EQ(parts.size(), 3U);
  EXPECT_EQ(parts[2].faces, 1U);
  EXPECT_EQ(parts[2].area_uv, 0x1p-200);
}

TEST(ChartRunsTest, AnAreaThatIsNotFiniteIsAPartOfItsOwn) {
  ChartPart endless = face(0, 1, 1);
  endless.area_3d_or_length = INFINITY;
  const std::vector<ChartPart> parts = parts_of({face(0, 0, 1), endless, face(0, 2, 1)});
  ASSERT_EQ(parts.size(), 3U);
  const Chart chart = chart_of(parts);
  EXPECT_EQ(chart.faces, 3U);
  EXPECT_EQ(chart.area_uv, 3);
  EXPECT_TRUE(std::isnan(chart.area_3d));
}

std::vector<ChartPart> random_faces(int exponents) {
  std::mt19937 random(static_cast<unsigned>(exponents));
  std::vector<ChartPart> faces;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const double size = std::uniform_real_distribution<double>(0.5, 1)(random);
    const double sign = random() % 8 == 0 ? -1 : (random() % 8 == 0 ? 0 : 1);
    const int exponent = std::uniform_int_distribution<int>(0, exponents)(random);
    faces.push_back(face(0, i, sign * std::ldexp(size, -exponent),
                         random() % 4 == 0 ? ChartPart::kFlipped : 0));
  }
  return faces;
}

/// Small sizes, sizes of too many bits for two doubles, and for a window of 128 bits.
class ChartRunSizesTest : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Exponents, ChartRunSizesTest, testing::Values(0, 20, 60, 100, 500));

TEST_P(ChartRunSizesTest, TheChartIsTheSameAsOfSingleFaces) {
  const std::vector<ChartPart> faces = random_faces(GetParam());
  const std::vector<ChartPart> parts = parts_of(faces);
  EXPECT_LE(parts.size(), faces.size());
  const Chart chart = chart_of(parts), expected = chart_of(faces);
  EXPECT_EQ(chart.faces, faces.size());
  EXPECT_EQ(chart.area_uv, expected.area_uv);
  EXPECT_EQ(chart.area_3d, expected.area_3d);
  EXPECT_EQ(chart.folds, expected.folds);
  EXPECT_EQ(chart.uv_box.high_u, expected.uv_box.high_u);
}

}  // namespace
}  // namespace atlasgauge
