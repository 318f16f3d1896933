#include "stream/mesh/edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <vector>

#include "tests/stream/mesh/stages.hpp"

namespace atlasgauge {
namespace {

/// Edges by their number of faces.
template <class Edge>
std::map<std::uint64_t, int> by_faces(const std::vector<Edge>& edges) {
  std::map<std::uint64_t, int> counts;
  for (const Edge& edge : edges) ++counts[edge.faces];
  return counts;
}

using FaceCounts = std::map<std::uint64_t, int>;
using LinkTuple = std::tuple<std::uint32_t, std::uint32_t, bool, bool>;

std::set<LinkTuple> tuples(Spill<Link>& links) {
  std::set<LinkTuple> set;
  for (const Link& link : records_of(links)) {
    set.emplace(link.a(), link.b(), link.manifold(), link.parity());
  }
  return set;
}

class EdgesTest : public testing::TestWithParam<std::size_t> {
 protected:
  Stages& edges_of(const SmallMesh& mesh, const TextureSlots& slots = one_image()) {
    stages_.reset();
    engine_ = std::make_unique<TestEngine>(EngineOptions{.workers = GetParam()});
    stages_ = std::make_unique<Stages>(*engine_, mesh, slots);
    stages_->run_edges();
    return *stages_;
  }

 private:
  std::unique_ptr<TestEngine> engine_;
  std::unique_ptr<Stages> stages_;
};
INSTANTIATE_TEST_SUITE_P(Workers, EdgesTest, testing::Values(1, 2, 3));

/// Two faces over the diagonal (1, 2) of a unit square.
SmallMesh two_triangles() {
  return grid_mesh(2, 2);
}

/// The same, cut open: both faces have vertices of their own.
SmallMesh two_triangles_cut() {
  SmallMesh mesh = two_triangles();
  mesh.positions.push_back(mesh.positions[1]);
  mesh.positions.push_back(mesh.positions[2]);
  mesh.faces[1].v[0] = VertexId{4};
  mesh.faces[1].v[2] = VertexId{5};
  return mesh;
}

TEST_P(EdgesTest, TwoTrianglesShareOneEdge) {
  Stages& stages = edges_of(two_triangles());
  EXPECT_EQ(by_faces(stages.groups.raw_edges), (FaceCounts{{1, 4}, {2, 1}}));
  EXPECT_EQ(by_faces(stages.groups.uv_edges), (FaceCounts{{1, 4}, {2, 1}}));
  EXPECT_EQ(tuples(stages.edges.raw_links), (std::set<LinkTuple>{{0, 1, true, false}}));
  EXPECT_EQ(tuples(stages.edges.uv_links), (std::set<LinkTuple>{{0, 1, true, false}}));
  EXPECT_TRUE(stages.edges.seams.empty());
}

TEST_P(EdgesTest, LengthsAreThoseOfTheEdge) {
  Stages& stages = edges_of(two_triangles(), one_image(2, 2));
  for (const RawEdge& edge : stages.groups.raw_edges) {
    EXPECT_EQ(edge.length_3d, edge.faces == 2 ? std::sqrt(2.0) : 1.0);
  }
  for (const UvEdge& edge : stages.groups.uv_edges) {
    EXPECT_EQ(edge.length_texels, edge.faces == 2 ? std::sqrt(2.0) : 1.0);
  }
}

TEST_P(EdgesTest, BoundaryLinksAreTheEndsOfOpenEdges) {
  Stages& stages = edges_of(two_triangles());
  std::set<std::pair<std::uint32_t, std::uint32_t>> ends;
  for (const Link& link : records_of(stages.edges.boundary_links)) ends.emplace(link.a(), link.b());
  EXPECT_EQ(ends,
            (std::set<std::pair<std::uint32_t, std::uint32_t>>{{0, 1}, {0, 2}, {1, 3}, {2, 3}}));
}

TEST_P(EdgesTest, FlippedFaceGivesAParity) {
  SmallMesh mesh = two_triangles();
  std::swap(mesh.faces[1].v[0], mesh.faces[1].v[1]);
  std::swap(mesh.faces[1].t[0], mesh.faces[1].t[1]);
  Stages& stages = edges_of(mesh);
  EXPECT_EQ(tuples(stages.edges.raw_links), (std::set<LinkTuple>{{0, 1, true, true}}));
  EXPECT_EQ(tuples(stages.edges.uv_links), (std::set<LinkTuple>{{0, 1, true, true}}));
  for (const RawEdge& edge : stages.groups.raw_edges) EXPECT_FALSE(edge.coherent);
}

TEST_P(EdgesTest, UvJumpIsASeam) {
  SmallMesh mesh = two_triangles();
  for (const float v : {0.25F, 0.75F}) mesh.uv(0.9F, v);
  mesh.faces[1].t[0] = TexCoordId{4};
  mesh.faces[1].t[2] = TexCoordId{5};
  Stages& stages = edges_of(mesh);
  EXPECT_EQ(by_faces(stages.groups.raw_edges), (FaceCounts{{1, 4}, {2, 1}}));
  EXPECT_EQ(by_faces(stages.groups.uv_edges), (FaceCounts{{1, 6}}));
  EXPECT_TRUE(stages.edges.uv_links.empty());
  const std::vector<SeamCandidate> seams = records_of(stages.edges.seams);
  ASSERT_EQ(seams.size(), 1U);
  EXPECT_EQ(seams[0].length_3d, std::sqrt(2.0));
  EXPECT_TRUE(seams[0].sampled);
  EXPECT_EQ(raw(seams[0].faces[0]) + raw(seams[0].faces[1]), 1U);
}

TEST_P(EdgesTest, UvsThatMeetAtOneEndOnlyAreASeam) {
  SmallMesh mesh = two_triangles();
  mesh.uv(0.9F, 0.9F);
  mesh.faces[1].t[0] = TexCoordId{4};
  EXPECT_EQ(edges_of(mesh).edges.seams.size(), 1U);
}

TEST_P(EdgesTest, EqualUvsOfOtherIndicesAreNoSeam) {
  SmallMesh mesh = two_triangles();
  mesh.texcoords.push_back(mesh.texcoords[1]);
  mesh.texcoords.push_back(mesh.texcoords[2]);
  mesh.faces[1].t[0] = TexCoordId{4};
  mesh.faces[1].t[2] = TexCoordId{5};
  EXPECT_TRUE(edges_of(mesh).edges.seams.empty());
}

TEST_P(EdgesTest, ChangeOfTextureIsASeam) {
  SmallMesh mesh = two_triangles();
  mesh.faces[1].material = MaterialId{1};
  TextureSlots slots = one_image();
  slots.slots.push_back(slots.slots[0]);
  slots.of_material.push_back(SlotId{1});
  Stages& stages = edges_of(mesh, slots);
  EXPECT_EQ(stages.edges.seams.size(), 1U);
  EXPECT_TRUE(stages.edges.uv_links.empty());
}

TEST_P(EdgesTest, FacesWithoutUvsShareTheirEdge) {
  SmallMesh mesh = two_triangles();
  for (FaceRecord& face : mesh.faces) {
    for (TexCoordId& t : face.t) t = kNone<TexCoordId>;
  }
  Stages& stages = edges_of(mesh);
  EXPECT_EQ(by_faces(stages.groups.uv_edges), (FaceCounts{{1, 4}, {2, 1}}));
  for (const UvEdge& edge : stages.groups.uv_edges) EXPECT_EQ(edge.length_texels, 0);
}

TEST_P(EdgesTest, SeamWithoutUvTriangleOrImageIsUnsampled) {
  SmallMesh mesh = two_triangles();
  mesh.faces[1].t[0] = kNone<TexCoordId>;
  const std::vector<SeamCandidate> seams = records_of(edges_of(mesh).edges.seams);
  ASSERT_EQ(seams.size(), 1U);
  EXPECT_FALSE(seams[0].sampled);

  mesh.uv(0.9F, 0.9F);
  mesh.faces[1].t[0] = TexCoordId{4};
  TextureSlots unreadable = one_image();
  unreadable.slots[0].readable = false;
  EXPECT_FALSE(records_of(edges_of(mesh, unreadable).edges.seams).at(0).sampled);
}

TEST_P(EdgesTest, WeldedSeamJoinsWhatTheIndicesCut) {
  Stages& stages = edges_of(two_triangles_cut());
  EXPECT_EQ(by_faces(stages.groups.raw_edges), (FaceCounts{{1, 6}}));
  EXPECT_TRUE(stages.edges.raw_links.empty());
  EXPECT_EQ(by_faces(stages.groups.uv_edges), (FaceCounts{{1, 4}, {2, 1}}));
  EXPECT_EQ(tuples(stages.edges.uv_links), (std::set<LinkTuple>{{0, 1, true, false}}));
  EXPECT_EQ(stages.edges.boundary_links.size(), 6U);
}

TEST_P(EdgesTest, WeldedSeamWithAUvJumpIsASeamEdge) {
  SmallMesh mesh = two_triangles_cut();
  mesh.uv(0.9F, 0.9F);
  mesh.faces[1].t[0] = TexCoordId{4};
  EXPECT_EQ(edges_of(mesh).edges.seams.size(), 1U);
}

TEST_P(EdgesTest, WeldedDegenerateFaceIsOnRawEdgesOnly) {
  SmallMesh mesh = two_triangles();
  const std::uint32_t twin = mesh.vertex(0, 0);  // where vertex 0 lies
  mesh.face({0, twin, 1}, kNoUvs);
  Stages& stages = edges_of(mesh);
  // (0,1) has two faces now; (0,twin) and (twin,1) have one.
  EXPECT_EQ(by_faces(stages.groups.raw_edges), (FaceCounts{{1, 5}, {2, 2}}));
  EXPECT_EQ(by_faces(stages.groups.uv_edges), (FaceCounts{{1, 4}, {2, 1}}));
  EXPECT_TRUE(stages.edges.seams.empty());
}

TEST_P(EdgesTest, DegenerateAndNonFiniteFacesHaveNoEdges) {
  SmallMesh mesh = two_triangles();
  mesh.face({0, 0, 1}, kNoUvs);
  mesh.face({0, 1, mesh.vertex(NAN, 0)}, kNoUvs);
  EXPECT_EQ(edges_of(mesh).groups.raw_edges.size(), 5U);
}

TEST_P(EdgesTest, FinLinksItsFacesInAChain) {
  Stages& stages = edges_of(book(3));
  EXPECT_EQ(by_faces(stages.groups.raw_edges), (FaceCounts{{1, 6}, {3, 1}}));
  EXPECT_FALSE(stages.edges.raw_manifold);
  EXPECT_FALSE(stages.edges.uv_manifold);
  const std::vector<Link> links = records_of(stages.edges.raw_links);
  EXPECT_EQ(links.size(), 2U);
  for (const Link& link : links) EXPECT_FALSE(link.manifold());
  EXPECT_TRUE(stages.edges.seams.empty());
}

TEST_P(EdgesTest, FinAtTheRawLevelMayBeManifoldInUv) {
  SmallMesh mesh = book(3);
  for (int i = 0; i < 9; ++i) mesh.uv(static_cast<float>(i) / 9, 0.5F);
  for (std::uint32_t i = 0; i < 3; ++i) {
    for (std::uint32_t k = 0; k < 3; ++k) mesh.faces[i].t[k] = TexCoordId{i * 3 + k};
  }
  Stages& stages = edges_of(mesh);
  EXPECT_FALSE(stages.edges.raw_manifold);
  EXPECT_TRUE(stages.edges.uv_manifold);
  EXPECT_EQ(by_faces(stages.groups.uv_edges), (FaceCounts{{1, 9}}));
  EXPECT_TRUE(stages.edges.seams.empty()) << "three faces make no seam";
}

TEST_P(EdgesTest, DuplicateFacesShareAllEdges) {
  SmallMesh mesh = two_triangles();
  mesh.faces = {mesh.faces[0], mesh.faces[0]};
  Stages& stages = edges_of(mesh);
  EXPECT_EQ(by_faces(stages.groups.raw_edges), (FaceCounts{{2, 3}}));
  EXPECT_EQ(tuples(stages.edges.raw_links), (std::set<LinkTuple>{{0, 1, true, true}}));
}

TEST_P(EdgesTest, ClosedTetrahedronHasNoBoundary) {
  SmallMesh mesh;
  for (int i = 0; i < 4; ++i) mesh.vertex(i == 1, i == 2, i == 3);
  for (const Indices3& v : {Indices3{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
    mesh.face(v, kNoUvs);
  Stages& stages = edges_of(mesh);
  EXPECT_EQ(by_faces(stages.groups.raw_edges), (FaceCounts{{2, 6}}));
  for (const RawEdge& edge : stages.groups.raw_edges) EXPECT_TRUE(edge.coherent);
  EXPECT_TRUE(stages.edges.boundary_links.empty());
}

TEST_P(EdgesTest, NoFacesHaveNoEdges) {
  Stages& stages = edges_of(SmallMesh{});
  EXPECT_TRUE(stages.groups.raw_edges.empty());
  EXPECT_TRUE(stages.edges.raw_manifold);
}

/// Small budgets, for which one vertex or one edge is too much.
struct HotMesh {
  HotMesh(const SmallMesh& mesh, std::uint64_t budget_bytes)
      : engine({.budget_bytes = budget_bytes}), stages(engine, mesh) {
    stages.run_edges();
  }
  TestEngine engine;
  Stages stages;
};

TEST(HotEdgesTest, FanVertexWithMoreEdgesThanMemory) {
  for (const std::uint64_t kib : {160, 16384}) {
    HotMesh hot(fan(20000, false), kib << 10);
    EXPECT_EQ(by_faces(hot.stages.groups.raw_edges), (FaceCounts{{1, 20002}, {2, 19999}}));
    EXPECT_EQ(hot.stages.edges.raw_links.size(), 19999U);
    EXPECT_TRUE(hot.stages.edges.raw_manifold);
  }
}

TEST(HotEdgesTest, EdgeWithMoreFacesThanMemory) {
  for (const std::uint64_t kib : {160, 16384}) {
    HotMesh hot(book(20000), kib << 10);
    EXPECT_EQ(by_faces(hot.stages.groups.raw_edges), (FaceCounts{{1, 40000}, {20000, 1}}));
    EXPECT_EQ(by_faces(hot.stages.groups.uv_edges), (FaceCounts{{1, 40000}, {20000, 1}}));
    EXPECT_EQ(hot.stages.edges.raw_links.size(), 19999U);
    EXPECT_FALSE(hot.stages.edges.raw_manifold);
    EXPECT_TRUE(hot.stages.edges.seams.empty());
  }
}

/// A book whose pages have one of three UVs at the spine, and whose last page is of another vertex
/// at the same place.
SmallMesh colourful_book(std::uint32_t pages) {
  SmallMesh mesh = book(pages);
  for (int i = 0; i < 4; ++i) mesh.uv(static_cast<float>(i) / 4, 0.25F * static_cast<float>(i % 2));
  for (std::uint32_t i = 0; i < pages; ++i) {
    mesh.faces[i].t[0] = TexCoordId{i % 3};
    mesh.faces[i].t[1] = mesh.faces[i].t[2] = TexCoordId{3};
  }
  mesh.positions.push_back(mesh.positions[0]);
  mesh.faces.back().v[0] = VertexId{static_cast<std::uint32_t>(mesh.positions.size() - 1)};
  return mesh;
}

TEST(HotEdgesTest, LargeEdgeIsSplitByUvAndByVertexAsAnyOther) {
  for (const std::uint32_t pages : {99U, 4095U, 4096U, 4097U, 4098U, 20001U}) {
    HotMesh hot(colourful_book(pages), 160 << 10);
    EXPECT_EQ(by_faces(hot.stages.groups.raw_edges),
              (FaceCounts{{1, 2 * static_cast<int>(pages) + 1}, {pages - 1, 1}}));
    FaceCounts uv = {{1, 2 * static_cast<int>(pages)}};
    for (std::uint32_t third = 0; third < 3; ++third) ++uv[(pages - third + 2) / 3];
    EXPECT_EQ(by_faces(hot.stages.groups.uv_edges), uv) << pages;
  }
}

}  // namespace
}  // namespace atlasgauge
