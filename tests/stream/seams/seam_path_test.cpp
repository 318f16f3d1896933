#include "stream/seams/seam_path.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace atlasgauge {
namespace {

void expect_footprint(const Footprint& footprint, std::int64_t x, std::int64_t y, double fx,
                      double fy) {
  EXPECT_EQ(footprint.x, x);
  EXPECT_EQ(footprint.y, y);
  EXPECT_DOUBLE_EQ(footprint.fx, fx);
  EXPECT_DOUBLE_EQ(footprint.fy, fy);
}

TEST(SeamPathTest, FiveSamplesATexelOfTheLongerSide) {
  EXPECT_EQ(sample_count(4, 2, 1e-6), 20U);
  EXPECT_EQ(sample_count(2, 4.1, 1e-6), 25U);
  EXPECT_EQ(sample_count(0, 0.1, 1e-6), 5U);
}

TEST(SeamPathTest, RoundingDoesNotMoveAWholeLength) {
  EXPECT_EQ(sample_count(4 + 9e-7, 0, 1e-6), 20U);
  EXPECT_EQ(sample_count(4 - 9e-7, 0, 1e-6), 20U);
  EXPECT_EQ(sample_count(4 + 1.1e-6, 0, 1e-6), 25U);
  EXPECT_EQ(sample_count(4 + 9e-7, 0, 0), 25U);
}

TEST(SeamPathTest, SidesOfNoLengthHaveNoSamples) {
  EXPECT_EQ(sample_count(0, 0, 1e-6), 0U);
  EXPECT_EQ(sample_count(5e-7, 1e-6, 1e-6), 0U);
}

TEST(SeamPathTest, SamplesLieInTheMiddleOfTheirParts) {
  const SeamPath path({2, 3}, {6, 3}, 4, 0.5);  // 2.5, 3.5, 4.5, 5.5
  expect_footprint(path.at(0), 2, 2, 0, 0.5);
  expect_footprint(path.at(3), 5, 2, 0, 0.5);
}

TEST(SeamPathTest, OffsetMovesSamplesToTheBeginning) {
  const SeamPath path({2, 3}, {2, 4}, 4, 0);  // 3, 3.25, 3.5, 3.75
  expect_footprint(path.at(0), 1, 2, 0.5, 0.5);
  expect_footprint(path.at(1), 1, 2, 0.5, 0.75);
  expect_footprint(path.at(2), 1, 3, 0.5, 0);
  expect_footprint(path.at(3), 1, 3, 0.5, 0.25);
}

TEST(SeamPathTest, FootprintsGoOnBelowZero) {
  const SeamPath path({0.25, -3.75}, {0.25, -3.75}, 1, 0.5);
  expect_footprint(path.at(0), -1, -5, 0.75, 0.75);
}

TEST(SeamPathTest, FootprintsFollowColumnsAndRows) {
  EXPECT_DOUBLE_EQ(SeamPath({0, 0}, {3, -4}, 25, 0.5).usual_footprints(), 8);
  EXPECT_DOUBLE_EQ(SeamPath({0, 0}, {300, 400}, 25, 0.5).usual_footprints(), 25);
  EXPECT_DOUBLE_EQ(SeamPath({7, 7}, {7, 7}, 25, 0.5).usual_footprints(), 1);
}

}  // namespace
}  // namespace atlasgauge
