#include "stream/mesh/components.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/stream/mesh/stages.hpp"

namespace atlasgauge {
namespace {

struct Parts {
  std::vector<std::uint64_t> faces;  ///< of the components, ascending
  std::int64_t unorientable = 0;
  std::uint64_t boundary = 0;
};

Parts parts_of(const SmallMesh& mesh, const EngineOptions& options = {}) {
  TestEngine engine(options);
  Stages stages(engine, mesh);
  stages.run_edges();
  const std::uint64_t boundary_vertices = stages.run_stars();
  stages.run_components();
  Parts parts;
  for (const Component& component : stages.groups.components) {
    parts.faces.push_back(component.faces);
    parts.unorientable += component.orientable ? 0 : 1;
  }
  std::sort(parts.faces.begin(), parts.faces.end());
  parts.boundary = stages.run_boundary(boundary_vertices);
  return parts;
}

using FaceCounts = std::vector<std::uint64_t>;

SmallMesh two_squares() {
  SmallMesh mesh = grid_mesh(2, 2);
  for (int i = 0; i < 4; ++i) mesh.vertex(10 + i % 2, i / 2);
  mesh.face({4, 5, 6}, kNoUvs);
  return mesh;
}

TEST(ComponentsTest, FacesOverSharedEdges) {
  EXPECT_EQ(parts_of(grid_mesh(2, 2)).faces, (FaceCounts{2}));
  EXPECT_EQ(parts_of(two_squares()).faces, (FaceCounts{1, 2}));
}

TEST(ComponentsTest, SharedVertexDoesNotConnect) {
  SmallMesh mesh;
  for (int i = 0; i < 5; ++i) mesh.vertex(i, i * i);
  mesh.face({0, 1, 2}, kNoUvs);
  mesh.face({0, 3, 4}, kNoUvs);
  const Parts parts = parts_of(mesh);
  EXPECT_EQ(parts.faces, (FaceCounts{1, 1}));
  EXPECT_EQ(parts.boundary, 1U) << "the two rims meet at the vertex";
}

TEST(ComponentsTest, NonManifoldEdgeConnects) {
  const Parts parts = parts_of(book(3));
  EXPECT_EQ(parts.faces, (FaceCounts{3}));
  EXPECT_EQ(parts.unorientable, 0);
}

TEST(ComponentsTest, WeldedSeamDoesNotConnect) {
  SmallMesh mesh = grid_mesh(2, 2);
  mesh.positions.push_back(mesh.positions[1]);
  mesh.positions.push_back(mesh.positions[2]);
  mesh.faces[1].v[0] = VertexId{4};
  mesh.faces[1].v[2] = VertexId{5};
  EXPECT_EQ(parts_of(mesh).faces, (FaceCounts{1, 1}));
}

TEST(ComponentsTest, MoebiusStripIsNotOrientable) {
  for (const std::uint32_t quads : {3U, 4U, 5U}) {
    const Parts parts = parts_of(moebius_strip(quads));
    EXPECT_EQ(parts.faces, (FaceCounts{2 * quads}));
    EXPECT_EQ(parts.unorientable, 1);
    EXPECT_EQ(parts.boundary, 1U);
  }
}

TEST(ComponentsTest, FlippedFaceCanBeFlippedBack) {
  SmallMesh mesh = grid_mesh(3, 3);
  std::swap(mesh.faces[3].v[0], mesh.faces[3].v[1]);
  EXPECT_EQ(parts_of(mesh).unorientable, 0);
}

TEST(ComponentsTest, MoebiusStripWithAFinStaysUnorientable) {
  SmallMesh mesh = moebius_strip(4);
  mesh.face({0, 2, mesh.vertex(100, 100)}, kNoUvs);
  mesh.face({0, 2, mesh.vertex(101, 100)}, kNoUvs);
  EXPECT_EQ(parts_of(mesh).unorientable, 1);
}

TEST(ComponentsTest, CutAlongAFinTheMoebiusStripIsOrientable) {
  // A third face on the rung (0,1) makes that edge non-manifold; what is left is a plain band.
  SmallMesh mesh = moebius_strip(4);
  mesh.face({0, 1, mesh.vertex(100, 100)}, kNoUvs);
  const Parts parts = parts_of(mesh);
  EXPECT_EQ(parts.faces, (FaceCounts{9}));
  EXPECT_EQ(parts.unorientable, 0);
}

TEST(ComponentsTest, UnusableFacesAreInNone) {
  SmallMesh mesh = two_squares();
  mesh.face({0, 0, 1}, kNoUvs);
  mesh.face({0, 1, mesh.vertex(NAN, 0)}, kNoUvs);
  EXPECT_EQ(parts_of(mesh).faces, (FaceCounts{1, 2}));
}

TEST(ComponentsTest, NoFaces) {
  const Parts parts = parts_of(SmallMesh{});
  EXPECT_TRUE(parts.faces.empty());
  EXPECT_EQ(parts.boundary, 0U);
}

TEST(BoundaryTest, OneRimAComponentOfEdges) {
  EXPECT_EQ(parts_of(grid_mesh(2, 2)).boundary, 1U);
  EXPECT_EQ(parts_of(two_squares()).boundary, 2U);
}

TEST(BoundaryTest, HoleHasARimOfItsOwn) {
  SmallMesh mesh = grid_mesh(4, 4);
  // The two faces of the middle cell.
  mesh.faces.erase(mesh.faces.begin() + 8, mesh.faces.begin() + 10);
  EXPECT_EQ(parts_of(mesh).boundary, 2U);
}

class ComponentsBudgetTest : public testing::TestWithParam<std::tuple<std::uint64_t, std::size_t>> {
 protected:
  EngineOptions options() const {
    return {.budget_bytes = std::get<0>(GetParam()) << 10, .workers = std::get<1>(GetParam())};
  }
};
INSTANTIATE_TEST_SUITE_P(BudgetsAndWorkers, ComponentsBudgetTest,
                         testing::Combine(testing::Values(160, 16384), testing::Values(1, 3)));

TEST_P(ComponentsBudgetTest, OneLargeComponent) {
  const Parts parts = parts_of(grid_mesh(100, 100), options());
  EXPECT_EQ(parts.faces, (FaceCounts{2 * 99 * 99}));
  EXPECT_EQ(parts.boundary, 1U);
  EXPECT_EQ(parts.unorientable, 0);
}

TEST_P(ComponentsBudgetTest, EveryFaceForItself) {
  SmallMesh mesh;
  for (std::uint32_t i = 0; i < 15000; ++i) {
    mesh.face({mesh.vertex(i, 0), mesh.vertex(i, 1), mesh.vertex(i, 2)}, kNoUvs);
  }
  const Parts parts = parts_of(mesh, options());
  EXPECT_EQ(parts.faces, FaceCounts(15000, 1));
  EXPECT_EQ(parts.boundary, 15000U);
}

TEST_P(ComponentsBudgetTest, TwoComponentsFaceByFace) {
  // Two grids whose faces alternate: a run of every face.
  SmallMesh mesh = grid_mesh(90, 90);
  const auto shift = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t v = 0; v < shift; ++v) {
    Position p = mesh.positions[v];
    p.z = 5;
    mesh.positions.push_back(p);
  }
  std::vector<FaceRecord> faces;
  for (FaceRecord face : mesh.faces) {
    faces.push_back(face);
    for (VertexId& v : face.v) v = VertexId{raw(v) + shift};
    faces.push_back(face);
  }
  mesh.faces = faces;
  const Parts parts = parts_of(mesh, options());
  EXPECT_EQ(parts.faces, (FaceCounts{2 * 89 * 89, 2 * 89 * 89}));
}

TEST_P(ComponentsBudgetTest, LongMoebiusStrip) {
  const Parts parts = parts_of(moebius_strip(8000), options());
  EXPECT_EQ(parts.unorientable, 1);
  EXPECT_EQ(parts.boundary, 1U);
}

}  // namespace
}  // namespace atlasgauge
