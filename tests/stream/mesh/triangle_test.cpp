#include "stream/mesh/triangle.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

#include "stream/mesh/records.hpp"

namespace atlasgauge {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

TEST(TriangleTest, AreaIsHalfTheCrossProduct) {
  EXPECT_EQ(triangle_area({0, 0, 0}, {3, 0, 0}, {0, 4, 0}), 6);
  EXPECT_EQ(triangle_area({1, 1, 1}, {1, 4, 1}, {1, 1, 5}), 6);
  EXPECT_EQ(triangle_area({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), 0);
}

TEST(TriangleTest, SignedAreaIsPositiveCounterclockwise) {
  EXPECT_EQ(signed_area({0, 0}, {2, 0}, {0, 3}), 3);
  EXPECT_EQ(signed_area({0, 0}, {0, 3}, {2, 0}), -3);
  EXPECT_EQ(signed_area({0, 0}, {1, 1}, {2, 2}), 0);
}

TEST(TriangleTest, Distances) {
  EXPECT_EQ(distance(Position{1, 1, 1}, Position{3, 4, 7}), 7);
  EXPECT_EQ(distance(Texel{1, 1}, Texel{4, 5}), 5);
}

TEST(TriangleTest, FiniteInEveryCoordinate) {
  EXPECT_TRUE(is_finite(Position{1, 2, 3}));
  EXPECT_FALSE(is_finite(Position{1, kInf, 3}));
  EXPECT_FALSE(is_finite(TexCoord{1, std::numeric_limits<float>::infinity()}));
  EXPECT_FALSE(is_finite(kNoTexCoord));
}

TEST(SlotFrameTest, TexelIsTheShiftedUvTimesTheSize) {
  SlotFrame frame;
  frame.width = 100;
  frame.height = 50;
  frame.shift_u = -1;
  frame.shift_v = 2;
  EXPECT_EQ(frame.texel({1.5F, 0.25F}).x, 50);
  EXPECT_EQ(frame.texel({1.5F, 0.25F}).y, 112.5);
}

TEST(SlotFramesTest, NoSlotHasNoSize) {
  SlotFrame sized;
  sized.has_size = true;
  const SlotFrames frames({sized});
  EXPECT_TRUE(frames.of(SlotId{0}).has_size);
  EXPECT_FALSE(frames.of(kNone<SlotId>).has_size);
}

Triangle of_kind(FaceKind kind) {
  Triangle triangle{};
  triangle.kind = kind;
  triangle.slot = SlotId{7};
  triangle.has_uv_triangle = true;
  triangle.t[1] = {0.5F, 0};
  triangle.t[2] = {0, 0.25F};
  return triangle;
}

TEST(FaceLevelsTest, AreThoseOfTheKind) {
  EXPECT_EQ(levels_of(of_kind(FaceKind::kWhole)), FaceLevels::kRawAndWelded);
  EXPECT_EQ(levels_of(of_kind(FaceKind::kWeldedDegenerate)), FaceLevels::kRaw);
  EXPECT_EQ(levels_of(of_kind(FaceKind::kNonFinite)), FaceLevels::kNone);
  EXPECT_EQ(levels_of(of_kind(FaceKind::kDegenerate)), FaceLevels::kNone);
}

TEST(AtlasFaceTest, AreaIsThatOnTheSlot) {
  SlotFrame frame;
  frame.width = 100;
  frame.height = 40;
  Triangle triangle = of_kind(FaceKind::kWhole);
  EXPECT_EQ(AtlasFace(triangle).area_uv(frame), 250);
  std::swap(triangle.t[1], triangle.t[2]);
  EXPECT_EQ(AtlasFace(triangle).area_uv(frame), -250);
  triangle.has_uv_triangle = false;
  EXPECT_EQ(AtlasFace(triangle).area_uv(frame), 0);
}

TEST(AtlasFaceTest, FlagsAndSlotShareTheBits) {
  Triangle triangle = of_kind(FaceKind::kWhole);
  EXPECT_TRUE(AtlasFace(triangle).at_welded_level());
  EXPECT_TRUE(AtlasFace(triangle).is_drawn());
  EXPECT_EQ(AtlasFace(triangle).slot(), SlotId{7});
  triangle.uv_far = true;
  EXPECT_TRUE(AtlasFace(triangle).has_uv_triangle());
  EXPECT_FALSE(AtlasFace(triangle).is_drawn());
  triangle.slot = kNone<SlotId>;
  EXPECT_EQ(AtlasFace(triangle).slot(), kNone<SlotId>);
  const AtlasFace degenerate(of_kind(FaceKind::kWeldedDegenerate));
  EXPECT_FALSE(degenerate.at_welded_level());
  EXPECT_FALSE(degenerate.has_uv_triangle());
}

TEST(HalfEdgeTest, FlagsAndSlotShareTheBits) {
  HalfEdge half_edge{};
  half_edge.bits = HalfEdge::kForward | HalfEdge::kUnsampled | 12345;
  EXPECT_TRUE(half_edge.forward());
  EXPECT_FALSE(half_edge.raw_only());
  EXPECT_FALSE(half_edge.has_uv_triangle());
  EXPECT_FALSE(half_edge.sampled());
  EXPECT_EQ(half_edge.slot(), SlotId{12345});
  half_edge.bits = HalfEdge::kSlotMask;
  EXPECT_EQ(half_edge.slot(), kNone<SlotId>);
  EXPECT_TRUE(half_edge.sampled());
}

}  // namespace
}  // namespace atlasgauge
