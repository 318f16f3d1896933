#include "stream/mesh/stars.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/stream/mesh/stages.hpp"

namespace atlasgauge {
namespace {

struct Stars {
  std::vector<VertexStar> all;
  std::uint64_t boundary_vertices = 0;

  std::int64_t count(bool (*of)(const VertexStar&)) const {
    return std::count_if(all.begin(), all.end(), of);
  }
  std::int64_t nonmanifold_vertices() const {
    return count([](const VertexStar& s) { return !s.nonmanifold_edge && !s.one_fan; });
  }
  std::int64_t on_nonmanifold_edges() const {
    return count([](const VertexStar& s) { return s.nonmanifold_edge; });
  }
  std::uint64_t duplicate_faces() const {
    std::uint64_t sum = 0;
    for (const VertexStar& star : all) sum += star.duplicate_faces;
    return sum;
  }
  std::uint64_t corners() const {
    std::uint64_t sum = 0;
    for (const VertexStar& star : all) sum += star.corners;
    return sum;
  }
  const VertexStar& largest() const {
    return *std::max_element(all.begin(), all.end(), [](const VertexStar& a, const VertexStar& b) {
      return a.corners < b.corners;
    });
  }
};

Stars stars_of(const SmallMesh& mesh, const EngineOptions& options = {}) {
  TestEngine engine(options);
  Stages stages(engine, mesh);
  Stars stars;
  stars.boundary_vertices = stages.run_stars();
  stars.all = stages.groups.stars;
  return stars;
}

SmallMesh tetrahedron() {
  SmallMesh mesh;
  for (int i = 0; i < 4; ++i) mesh.vertex(i == 1, i == 2, i == 3);
  for (const Indices3& v : {Indices3{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
    mesh.face(v, kNoUvs);
  return mesh;
}

/// Two triangles that meet at vertex 0 only.
SmallMesh bow_tie() {
  SmallMesh mesh;
  for (int i = 0; i < 5; ++i) mesh.vertex(i, i * i);
  mesh.face({0, 1, 2}, kNoUvs);
  mesh.face({0, 3, 4}, kNoUvs);
  return mesh;
}

/// Two closed fans that meet at vertex 0 only.
SmallMesh two_cones(std::uint32_t triangles) {
  SmallMesh mesh = fan(triangles, true);
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i < triangles; ++i) mesh.vertex(std::cos(i), std::sin(i), i + 0.5);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    mesh.face({0, first + i, first + (i + 1) % triangles}, kNoUvs);
  }
  return mesh;
}

TEST(StarsTest, TetrahedronHasFourClosedFans) {
  const Stars stars = stars_of(tetrahedron());
  ASSERT_EQ(stars.all.size(), 4U);
  for (const VertexStar& star : stars.all) {
    EXPECT_EQ(star.corners, 3U);
    EXPECT_EQ(star.boundary_edges, 0U);
    EXPECT_TRUE(star.one_fan);
    EXPECT_FALSE(star.nonmanifold_edge);
  }
  EXPECT_EQ(stars.boundary_vertices, 0U);
}

TEST(StarsTest, TwoTrianglesHaveFourBoundaryVertices) {
  const Stars stars = stars_of(grid_mesh(2, 2));
  EXPECT_EQ(stars.boundary_vertices, 4U);
  EXPECT_EQ(stars.corners(), 6U);
  EXPECT_EQ(stars.nonmanifold_vertices(), 0);
}

TEST(StarsTest, BowTieHasOneNonManifoldVertex) {
  const Stars stars = stars_of(bow_tie());
  EXPECT_EQ(stars.nonmanifold_vertices(), 1);
  EXPECT_EQ(stars.largest().boundary_edges, 4U);
  EXPECT_EQ(stars.boundary_vertices, 5U);
}

TEST(StarsTest, TwoClosedFansAtAVertexAreNonManifold) {
  const Stars stars = stars_of(two_cones(5));
  EXPECT_EQ(stars.nonmanifold_vertices(), 1);
  EXPECT_EQ(stars.largest().boundary_edges, 0U);
}

TEST(StarsTest, FinIsAMatterOfItsEdge) {
  const Stars stars = stars_of(book(3));
  EXPECT_EQ(stars.on_nonmanifold_edges(), 2);
  EXPECT_EQ(stars.nonmanifold_vertices(), 0);
}

TEST(StarsTest, MoebiusStripIsManifold) {
  for (const std::uint32_t quads : {3U, 4U, 5U}) {
    const Stars stars = stars_of(moebius_strip(quads));
    EXPECT_EQ(stars.all.size(), 2 * quads);
    EXPECT_EQ(stars.nonmanifold_vertices(), 0);
    EXPECT_EQ(stars.on_nonmanifold_edges(), 0);
    EXPECT_EQ(stars.boundary_vertices, 2 * quads);
  }
}

TEST(StarsTest, DuplicateFacesAreCountedOnceWhateverTheirCornerOrder) {
  SmallMesh mesh = tetrahedron();
  mesh.face({2, 1, 0}, kNoUvs);
  mesh.face({1, 0, 2}, kNoUvs);
  mesh.face({3, 2, 1}, kNoUvs);
  EXPECT_EQ(stars_of(mesh).duplicate_faces(), 3U);
  EXPECT_EQ(stars_of(tetrahedron()).duplicate_faces(), 0U);
}

TEST(StarsTest, DuplicatesAreARawAffair) {
  SmallMesh mesh = tetrahedron();
  mesh.positions.push_back(mesh.positions[0]);
  mesh.face({4, 2, 1}, kNoUvs);
  EXPECT_EQ(stars_of(mesh).duplicate_faces(), 0U);
}

TEST(StarsTest, OnlyUsedVerticesOfUsableFacesHaveAStar) {
  SmallMesh mesh = tetrahedron();
  mesh.vertex(7, 7);                               // unused
  mesh.face({0, 0, mesh.vertex(8, 8)}, kNoUvs);    // degenerate
  mesh.face({0, 1, mesh.vertex(NAN, 0)}, kNoUvs);  // not finite
  mesh.face({0, mesh.vertex(0, 0), 1}, kNoUvs);    // degenerate only when welded
  EXPECT_EQ(stars_of(mesh).all.size(), 5U);
}

TEST(StarsTest, NoFacesHaveNoStars) {
  EXPECT_TRUE(stars_of(SmallMesh{}).all.empty());
  EXPECT_EQ(stars_of(SmallMesh{}).boundary_vertices, 0U);
}

TEST(StarsTest, GridStarsForAnyBudgetAndWorkers) {
  for (const std::uint64_t kib : {160, 16384}) {
    for (const std::size_t workers : {1U, 3U}) {
      const Stars stars =
          stars_of(grid_mesh(80, 80), {.budget_bytes = kib << 10, .workers = workers});
      EXPECT_EQ(stars.all.size(), 6400U);
      EXPECT_EQ(stars.corners(), 3U * 2 * 79 * 79);
      EXPECT_EQ(stars.boundary_vertices, 4U * 79);
      EXPECT_EQ(stars.nonmanifold_vertices(), 0);
    }
  }
}

/// One vertex of which has more corners than a worker's memory holds.
class HotStarTest : public testing::TestWithParam<std::uint64_t> {
 protected:
  Stars hot_stars(const SmallMesh& mesh) {
    return stars_of(mesh, {.budget_bytes = GetParam() << 10});
  }
};
INSTANTIATE_TEST_SUITE_P(Budgets, HotStarTest, testing::Values(160, 16384));

TEST_P(HotStarTest, ClosedFanIsOneFan) {
  const Stars stars = hot_stars(fan(20000, true));
  EXPECT_EQ(stars.largest().corners, 20000U);
  EXPECT_EQ(stars.largest().boundary_edges, 0U);
  EXPECT_EQ(stars.nonmanifold_vertices(), 0);
  EXPECT_EQ(stars.boundary_vertices, 20000U);
}

TEST_P(HotStarTest, OpenFanHasTwoBoundaryEdges) {
  const Stars stars = hot_stars(fan(20000, false));
  EXPECT_EQ(stars.largest().boundary_edges, 2U);
  EXPECT_TRUE(stars.largest().one_fan);
  EXPECT_EQ(stars.boundary_vertices, 20002U);
}

TEST_P(HotStarTest, TwoFansAreNonManifold) {
  const Stars stars = hot_stars(two_cones(10000));
  EXPECT_EQ(stars.largest().corners, 20000U);
  EXPECT_FALSE(stars.largest().one_fan);
  EXPECT_EQ(stars.nonmanifold_vertices(), 1);
}

TEST_P(HotStarTest, NonManifoldEdgeIsNoticed) {
  const Stars stars = hot_stars(book(20000));
  EXPECT_EQ(stars.on_nonmanifold_edges(), 2);
}

TEST_P(HotStarTest, DuplicateFacesAreCounted) {
  SmallMesh mesh = fan(20000, true);
  for (std::uint32_t i = 0; i < 20000; i += 2) {
    FaceRecord again = mesh.faces[i];
    std::swap(again.v[1], again.v[2]);
    mesh.faces.push_back(again);
  }
  EXPECT_EQ(hot_stars(mesh).duplicate_faces(), 10000U);
}

}  // namespace
}  // namespace atlasgauge
