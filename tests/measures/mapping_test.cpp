#include "measures/mapping.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace atlasgauge {
namespace {

/// A whole face with these corners in 3D and in texels.
Triangle mapped(const Position& p0, const Position& p1, const Position& p2, const Texel& t0,
                const Texel& t1, const Texel& t2) {
  Triangle triangle{};
  triangle.kind = FaceKind::kWhole;
  triangle.has_uv_triangle = true;
  triangle.p[0] = p0;
  triangle.p[1] = p1;
  triangle.p[2] = p2;
  triangle.texel[0] = t0;
  triangle.texel[1] = t1;
  triangle.texel[2] = t2;
  triangle.area_3d = triangle_area(p0, p1, p2);
  triangle.area_uv = signed_area(t0, t1, t2);
  return triangle;
}

/// The unit right triangle in the plane z = 1, with these texels.
Triangle unit(const Texel& t0, const Texel& t1, const Texel& t2) {
  return mapped({0, 0, 1}, {1, 0, 1}, {0, 1, 1}, t0, t1, t2);
}

double distortion(const Triangle& triangle) {
  return quasi_conformal_distortion(triangle);
}

TEST(MappingTest, ConformalMapIsExactlyOne) {
  EXPECT_EQ(distortion(unit({0, 0}, {1, 0}, {0, 1})), 1);
  EXPECT_EQ(distortion(unit({7, 5}, {7 + 1024, 5}, {7, 5 + 1024})), 1) << "moved and scaled";
  EXPECT_EQ(distortion(unit({0, 0}, {0, 3}, {-3, 0})), 1) << "turned by a right angle";
  EXPECT_EQ(distortion(unit({0, 0}, {3, 4}, {-4, 3})), 1) << "turned by any angle";
}

TEST(MappingTest, ReflectionIsConformalToo) {
  EXPECT_EQ(distortion(unit({0, 0}, {0, 1}, {1, 0})), 1);
  EXPECT_EQ(distortion(unit({0, 0}, {-2, 0}, {0, 2})), 1);
}

TEST(MappingTest, StretchByTwoIsTwo) {
  EXPECT_EQ(distortion(unit({0, 0}, {2, 0}, {0, 1})), 2);
  EXPECT_EQ(distortion(unit({0, 0}, {1, 0}, {0, 2})), 2);
  EXPECT_EQ(distortion(unit({0, 0}, {0, 2}, {-1, 0})), 2) << "turned";
  EXPECT_EQ(distortion(unit({0, 0}, {0, 2}, {1, 0})), 2) << "reflected";
  EXPECT_EQ(distortion(unit({0, 0}, {0.5, 0}, {0, 0.25})), 2) << "scaled";
}

TEST(MappingTest, ShearByOneIsTheSquareOfTheGoldenRatio) {
  const double golden = (1 + std::sqrt(5.0)) / 2;
  EXPECT_NEAR(distortion(unit({0, 0}, {1, 0}, {1, 1})), golden * golden, 1e-14);
}

TEST(MappingTest, StretchInSpaceIsAsBadAsInTexels) {
  EXPECT_EQ(distortion(mapped({0, 0, 0}, {0, 0, 4}, {0, 1, 0}, {0, 0}, {1, 0}, {0, 1})), 4);
}

TEST(MappingTest, WhichCornerIsFirstDoesNotMatter) {
  const Position p[3] = {{0, 0, 0}, {3, 1, 2}, {1, 4, -1}};
  const Texel t[3] = {{10, 20}, {35, 22}, {12, 70}};
  const double first = distortion(mapped(p[0], p[1], p[2], t[0], t[1], t[2]));
  EXPECT_NEAR(distortion(mapped(p[1], p[2], p[0], t[1], t[2], t[0])), first, 1e-13 * first);
  EXPECT_NEAR(distortion(mapped(p[2], p[0], p[1], t[2], t[0], t[1])), first, 1e-13 * first);
  EXPECT_NEAR(distortion(mapped(p[1], p[0], p[2], t[1], t[0], t[2])), first, 1e-13 * first);
}

TEST(MappingTest, SliverKeepsItsDistortion) {
  // Stretched by 3 along its short side: exactly 3, however thin.
  for (const double thin : {0x1p-10, 0x1p-20, 0x1p-26}) {
    const Triangle triangle =
        mapped({0, 0, 0}, {1, 0, 0}, {0.5, thin, 0}, {0, 0}, {1, 0}, {0.5, 3 * thin});
    EXPECT_NEAR(distortion(triangle), 3, 1e-9) << thin;
  }
}

TEST(MappingTest, SquashedMapIsLargeNotInfinite) {
  EXPECT_NEAR(distortion(unit({0, 0}, {1, 0}, {0, 1e-12})), 1e12, 1);
}

TEST(MappingTest, NeverBelowOne) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto number = [&] { return any(random); };
  for (int i = 0; i < 10000; ++i) {
    const double angle = 3 * number(), scale = 1 + number() / 2;
    const double c = scale * std::cos(angle), s = scale * std::sin(angle);
    const double x = 1 + number() / 2, y = number();
    const Triangle similar =
        mapped({0, 0, 0}, {1, 0, 0}, {y, x, 0}, {0, 0}, {c, s}, {c * y - s * x, s * y + c * x});
    ASSERT_GE(distortion(similar), 1);
    ASSERT_LT(distortion(similar), 1 + 1e-12);
  }
}

TEST(MappingTest, MappedNeedsBothAreasAndTheWeldedLevel) {
  Triangle triangle = unit({0, 0}, {1, 0}, {0, 1});
  EXPECT_TRUE(is_mapped(triangle));
  triangle.area_uv = -0.5;
  EXPECT_TRUE(is_mapped(triangle));
  triangle.kind = FaceKind::kWeldedDegenerate;
  EXPECT_FALSE(is_mapped(triangle));
  EXPECT_FALSE(is_mapped(unit({0, 0}, {1, 0}, {2, 0})));
  EXPECT_FALSE(is_mapped(mapped({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0}, {1, 0}, {0, 1})));
}

}  // namespace
}  // namespace atlasgauge
