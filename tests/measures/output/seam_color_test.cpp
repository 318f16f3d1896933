#include "measures/output/seam_color.hpp"

#include <gtest/gtest.h>

#include <array>
#include <limits>

namespace atlasgauge {
namespace {

std::array<int, 3> color(double discrepancy) {
  const Rgb rgb = seam_color(discrepancy);
  return {rgb.red, rgb.green, rgb.blue};
}

using Color = std::array<int, 3>;

TEST(SeamColorTest, StopsDouble) {
  EXPECT_EQ(color(0), (Color{0, 0, 128}));
  EXPECT_EQ(color(8), (Color{0, 192, 224}));
  EXPECT_EQ(color(16), (Color{0, 176, 0}));
  EXPECT_EQ(color(32), (Color{255, 224, 0}));
  EXPECT_EQ(color(64), (Color{224, 0, 0}));
}

TEST(SeamColorTest, IsLinearBetweenStops) {
  EXPECT_EQ(color(4), (Color{0, 96, 176}));
  EXPECT_EQ(color(40), (Color{247, 168, 0}));
}

TEST(SeamColorTest, IsRedUpToTheLargest) {
  EXPECT_EQ(color(65), color(64));
  EXPECT_EQ(color(441.7), color(64));
}

TEST(SeamColorTest, IsGreyForNoValue) {
  EXPECT_EQ(color(std::numeric_limits<double>::quiet_NaN()), (Color{128, 128, 128}));
}

}  // namespace
}  // namespace atlasgauge
