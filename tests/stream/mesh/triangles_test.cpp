#include "stream/mesh/triangles.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "tests/stream/mesh/stages.hpp"

namespace atlasgauge {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

/// Vertices 0 to 3 of the unit square, and their UVs; 4 lies where 0 does, 5 nowhere.
SmallMesh square() {
  SmallMesh mesh;
  mesh.vertex(0, 0);
  mesh.vertex(1, 0);
  mesh.vertex(1, 1);
  mesh.vertex(0, 1);
  mesh.vertex(0, 0);
  mesh.vertex(kInf, 0);
  mesh.uv(0, 0);
  mesh.uv(1, 0);
  mesh.uv(1, 1);
  mesh.uv(0, 1);
  return mesh;
}

std::vector<Triangle> triangles_of(const SmallMesh& mesh, const TextureSlots& slots = one_image()) {
  TestEngine engine;
  return Stages(engine, mesh, slots).triangles;
}

TEST(TrianglesTest, WholeFaceHasBothAreas) {
  SmallMesh mesh = square();
  mesh.face({0, 1, 2});
  const Triangle triangle = triangles_of(mesh, one_image(10, 20)).at(0);
  EXPECT_EQ(triangle.kind, FaceKind::kWhole);
  EXPECT_EQ(triangle.area_3d, 0.5);
  EXPECT_EQ(triangle.area_uv, 100);
  EXPECT_EQ(triangle.texel[2].x, 10);
  EXPECT_EQ(triangle.texel[2].y, 20);
  EXPECT_FALSE(triangle.uv_far);
}

TEST(TrianglesTest, MirroredUvTriangleHasNegativeArea) {
  SmallMesh mesh = square();
  mesh.face({0, 1, 2}, {0, 2, 1});
  EXPECT_EQ(triangles_of(mesh).at(0).area_uv, -0.5);
}

TEST(TrianglesTest, KindsOfFaces) {
  SmallMesh mesh = square();
  mesh.face({0, 1, 2}, kNoUvs);
  mesh.face({0, 1, 4}, kNoUvs);  // two corners coincide
  mesh.face({0, 1, 5}, kNoUvs);  // not finite
  mesh.face({1, 1, 2}, kNoUvs);  // a vertex twice
  mesh.face({5, 1, 5}, kNoUvs);  // both: degenerate only
  const std::vector<Triangle> triangles = triangles_of(mesh);
  EXPECT_EQ(triangles.at(0).kind, FaceKind::kWhole);
  EXPECT_EQ(triangles.at(1).kind, FaceKind::kWeldedDegenerate);
  EXPECT_EQ(triangles.at(2).kind, FaceKind::kNonFinite);
  EXPECT_EQ(triangles.at(3).kind, FaceKind::kDegenerate);
  EXPECT_EQ(triangles.at(4).kind, FaceKind::kDegenerate);
}

TEST(TrianglesTest, WeldedVertexRidesAlong) {
  SmallMesh mesh = square();
  mesh.face({4, 1, 2}, {0, 1, 2});
  const Triangle triangle = triangles_of(mesh).at(0);
  EXPECT_EQ(raw(triangle.v[0]), 4U);
  EXPECT_EQ(raw(triangle.w[0]), 0U);
}

TEST(TrianglesTest, CornerWithoutUvLeavesNoUvTriangle) {
  SmallMesh mesh = square();
  const std::uint32_t broken = mesh.uv(NAN, 0);
  mesh.face({0, 1, 2}, {0, 1, kNoUv});
  mesh.face({0, 1, 2}, {0, broken, 2});
  for (const Triangle& triangle : triangles_of(mesh)) {
    EXPECT_FALSE(triangle.has_uv_triangle);
    EXPECT_EQ(triangle.area_uv, 0);
    EXPECT_TRUE(is_finite(triangle.t[0]));
  }
}

TEST(TrianglesTest, SlotWithoutSizeLeavesNoUvTriangle) {
  SmallMesh mesh = square();
  mesh.face({0, 1, 2});
  TextureSlots slots = one_image();
  slots.slots[0].size.reset();
  const Triangle triangle = triangles_of(mesh, slots).at(0);
  EXPECT_FALSE(triangle.has_uv_triangle);
  EXPECT_FALSE(triangle.slot_has_size);
  EXPECT_EQ(triangle.slot, SlotId{0});
}

TEST(TrianglesTest, MaterialWithoutImageHasNoSlot) {
  SmallMesh mesh = square();
  mesh.face({0, 1, 2}, {0, 1, 2}, raw(kNone<MaterialId>));
  const Triangle triangle = triangles_of(mesh).at(0);
  EXPECT_EQ(triangle.slot, kNone<SlotId>);
  EXPECT_FALSE(triangle.has_uv_triangle);
}

TEST(TrianglesTest, FarBeginsBeyondTwoToTheThirtyTexels) {
  SmallMesh mesh = square();
  const std::uint32_t left = mesh.uv(-0x1p20F, 0), right = mesh.uv(0x1p20F, 0), top = mesh.uv(0, 1);
  mesh.face({0, 1, 2}, {left, right, top});
  EXPECT_FALSE(triangles_of(mesh, one_image(1024, 1)).at(0).uv_far);
  EXPECT_TRUE(triangles_of(mesh, one_image(1025, 1)).at(0).uv_far);
}

/// The shift of the only slot, of a face with these UVs.
SlotFrame frame_of(const std::vector<TexCoord>& uvs) {
  SmallMesh mesh = square();
  mesh.texcoords = uvs;
  mesh.face({0, 1, 2});
  TestEngine engine;
  Stages stages(engine, mesh);
  return stages.frames.of(SlotId{0});
}

TEST(UvShiftTest, NoneWhileTheCentreLiesInTheUnitSquare) {
  EXPECT_EQ(frame_of({{-3, 0}, {5, 0}, {0, 1}}).shift_u, 0);  // centre 1
  EXPECT_EQ(frame_of({{-3, 0}, {3, 0}, {0, 1}}).shift_u, 0);  // centre 0
  EXPECT_EQ(frame_of({{0, 0}, {1, 0}, {0, 1}}).shift_u, 0);
}

TEST(UvShiftTest, CentreOutsideShiftsByWholeTextures) {
  const SlotFrame frame = frame_of({{2.25F, -7.5F}, {2.75F, -7.5F}, {2.5F, -6.5F}});
  EXPECT_EQ(frame.shift_u, -2);
  EXPECT_EQ(frame.shift_v, 8);
}

TEST(UvShiftTest, OneAxisOutsideShiftsBoth) {
  const SlotFrame frame = frame_of({{0.5F, 3.5F}, {0.75F, 3.5F}, {0.5F, 3.75F}});
  EXPECT_EQ(frame.shift_u, 0);
  EXPECT_EQ(frame.shift_v, -3);
  const SlotFrame both = frame_of({{-0.5F, 3.5F}, {0.75F, 3.5F}, {0.5F, 3.75F}});
  EXPECT_EQ(both.shift_u, 1);
}

TEST(UvShiftTest, DegenerateAndNonFiniteFacesHaveNoSay) {
  SmallMesh mesh = square();
  const std::uint32_t far = mesh.uv(50, 50);
  mesh.face({0, 1, 2});
  mesh.face({0, 0, 1}, {far, far, far});
  mesh.face({0, 1, 5}, {far, far, far});
  TestEngine engine;
  Stages stages(engine, mesh);
  EXPECT_EQ(stages.frames.of(SlotId{0}).shift_u, 0);
}

TEST(UvShiftTest, UnusedUvsHaveNoSay) {
  SmallMesh mesh = square();
  mesh.uv(50, 50);
  mesh.face({0, 1, 2});
  TestEngine engine;
  Stages stages(engine, mesh);
  EXPECT_EQ(stages.frames.of(SlotId{0}).shift_u, 0);
}

TEST(UvShiftTest, EverySlotHasItsOwn) {
  SmallMesh mesh = square();
  for (const float u : {4.5F, 4.75F, 4.5F}) mesh.uv(u, 0);
  mesh.face({0, 1, 2}, {0, 1, 2}, 0);
  mesh.face({0, 1, 2}, {4, 5, 6}, 1);
  TextureSlots slots = one_image();
  slots.slots.push_back(slots.slots[0]);
  slots.of_material.push_back(SlotId{1});
  TestEngine engine;
  Stages stages(engine, mesh, slots);
  EXPECT_EQ(stages.frames.of(SlotId{0}).shift_u, 0);
  EXPECT_EQ(stages.frames.of(SlotId{1}).shift_u, -4);
}

TEST(UvShiftTest, ShiftMovesTexelsNotTheUvsOfTheFile) {
  SmallMesh mesh = square();
  mesh.texcoords = {{4, 0}, {5, 0}, {5, 1}};
  mesh.face({0, 1, 2});
  const Triangle triangle = triangles_of(mesh, one_image(8, 8)).at(0);
  EXPECT_EQ(triangle.t[0].u, 4);
  EXPECT_EQ(triangle.texel[0].x, 0);
  EXPECT_EQ(triangle.area_uv, 32);
}

TEST(TrianglesTest, ManyFacesComeNumberedInOrder) {
  for (const std::size_t workers : {1U, 2U, 3U}) {
    TestEngine engine({.workers = workers});
    const Stages stages(engine, grid_mesh(50, 50));
    ASSERT_EQ(stages.triangles.size(), 2U * 49 * 49);
    for (std::uint32_t i = 0; i < stages.triangles.size(); ++i) {
      ASSERT_EQ(raw(stages.triangles[i].face), i);
    }
  }
}

}  // namespace
}  // namespace atlasgauge
