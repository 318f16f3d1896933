#include "stream/mesh/charts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "tests/stream/mesh/stages.hpp"

namespace atlasgauge {
namespace {

struct Atlas {
  std::vector<Chart> charts;  ///< by number
  std::vector<std::uint32_t> null_faces;
  std::vector<SeamCandidate> seams;
};

Atlas atlas_of(const SmallMesh& mesh, const EngineOptions& options = {}) {
  TestEngine engine(options);
  Stages stages(engine, mesh);
  stages.run_edges();
  Spill<FaceId> null_faces = stages.run_charts();
  Atlas atlas;
  for (const FaceId face : records_of(null_faces)) atlas.null_faces.push_back(raw(face));
  std::sort(atlas.null_faces.begin(), atlas.null_faces.end());
  atlas.seams = records_of(stages.run_seams(std::move(null_faces)));
  atlas.charts = stages.groups.charts;
  return atlas;
}

using FaceList = std::vector<std::uint32_t>;

/// Two faces over one edge, with UVs of their own: two charts.
SmallMesh two_charts() {
  SmallMesh mesh = grid_mesh(2, 2);
  mesh.uv(0.9F, 0.1F);
  mesh.uv(0.9F, 0.9F);
  mesh.uv(0.6F, 0.9F);
  mesh.faces[1].t[0] = TexCoordId{4};
  mesh.faces[1].t[1] = TexCoordId{5};
  mesh.faces[1].t[2] = TexCoordId{6};
  return mesh;
}

/// Flips a face with its UVs, which keeps the map and changes the side.
void turn_over(FaceRecord& face) {
  std::swap(face.v[0], face.v[1]);
  std::swap(face.t[0], face.t[1]);
}

/// A chart of a face with two small ones folded over it, and a face far away with an area in UV
/// 10^30 times larger.
SmallMesh folds_and_giant() {
  SmallMesh mesh;
  for (const Texel& at : {Texel{0, 0}, {1, 0}, {0, 1}, {0.5, -1}, {1, 1}}) mesh.vertex(at.x, at.y);
  mesh.texcoords = {{0, 0}, {1, 0}, {0, 1}, {0.3F, 0.05F}, {0.45F, 0.45F}};
  mesh.face({0, 1, 2});
  mesh.face({1, 0, 3});
  mesh.face({2, 1, 4});
  const std::uint32_t v = mesh.vertex(10, 0);
  mesh.vertex(11, 0);
  mesh.vertex(10, 1);
  const std::uint32_t t = mesh.uv(0, 0);
  mesh.uv(1e15F, 0);
  mesh.uv(0, 1e15F);
  mesh.face({v, v + 1, v + 2}, {t, t + 1, t + 2});
  return mesh;
}

// In units of the largest face the chart's areas would be 0, and the fewer of its signs the folds.
TEST(ChartsTest, AGiantElsewhereDoesNotHideFolds) {
  const Atlas atlas = atlas_of(folds_and_giant());
  ASSERT_EQ(atlas.charts.size(), 2U);
  EXPECT_EQ(atlas.charts[0].folds, 2U);
  EXPECT_NEAR(atlas.charts[0].area_uv, 0.5 + 0.025 + 0.05, 1e-6);
}

TEST(ChartsTest, OneChartOfTwoFaces) {
  const Atlas atlas = atlas_of(grid_mesh(2, 2));
  ASSERT_EQ(atlas.charts.size(), 1U);
  EXPECT_EQ(raw(atlas.charts[0].first_face), 0U);
  EXPECT_EQ(atlas.charts[0].faces, 2U);
  EXPECT_FALSE(atlas.charts[0].null);
  EXPECT_TRUE(atlas.charts[0].orientable);
  EXPECT_EQ(atlas.charts[0].folds, 0U);
}

TEST(ChartsTest, NumberIsTheSmallestFace) {
  SmallMesh mesh = two_charts();
  mesh.faces.insert(mesh.faces.begin(), mesh.faces[1]);
  mesh.faces.pop_back();
  mesh.faces.push_back(mesh.faces[0]);
  const Atlas atlas = atlas_of(mesh);
  ASSERT_EQ(atlas.charts.size(), 2U);
  EXPECT_EQ(raw(atlas.charts[0].first_face), 0U);
  EXPECT_EQ(atlas.charts[0].faces, 2U);
  EXPECT_EQ(raw(atlas.charts[1].first_face), 1U);
}

TEST(ChartsTest, FoldedFaceCounts) {
  SmallMesh mesh = grid_mesh(4, 4);
  mesh.texcoords[5] = {0.6F, 0.6F};  // an inner vertex pulled over its neighbours
  TestEngine engine;
  const Stages stages(engine, mesh);
  const auto folded = std::count_if(stages.triangles.begin(), stages.triangles.end(),
                                    [](const Triangle& triangle) { return triangle.area_uv < 0; });
  ASSERT_GT(folded, 0);
  const Atlas atlas = atlas_of(mesh);
  ASSERT_EQ(atlas.charts.size(), 1U);
  EXPECT_EQ(atlas.charts[0].folds, static_cast<std::uint64_t>(folded));
}

TEST(ChartsTest, MirroredChartHasNoFolds) {
  SmallMesh mesh = grid_mesh(4, 4);
  for (TexCoord& t : mesh.texcoords) t.u = 1 - t.u;
  EXPECT_EQ(atlas_of(mesh).charts.at(0).folds, 0U);
}

TEST(ChartsTest, FaceTurnedOverIsNoFold) {
  SmallMesh mesh = grid_mesh(4, 4);
  turn_over(mesh.faces[0]);
  turn_over(mesh.faces[7]);
  const Atlas atlas = atlas_of(mesh);
  EXPECT_EQ(atlas.charts.at(0).folds, 0U);
  EXPECT_TRUE(atlas.charts.at(0).orientable);
}

/// A square pyramid without its base, folded flat in UV: the four sides cover as much as they
/// uncover.
SmallMesh closed_in_uv() {
  SmallMesh mesh;
  for (const auto& [x, y] : {std::pair(0, 0), {4, 0}, {4, 4}, {0, 4}}) {
    mesh.vertex(x, y);
    mesh.uv(static_cast<float>(x) / 8, static_cast<float>(y) / 8);
  }
  mesh.vertex(2, 2, 3);
  mesh.uv(0.25F, 0.25F);
  mesh.vertex(2, 2, -3);
  mesh.uv(0.25F, 0.125F);
  for (std::uint32_t i = 0; i < 4; ++i) {
    mesh.face({i, (i + 1) % 4, 4});
    mesh.face({(i + 1) % 4, i, 5});
  }
  return mesh;
}

TEST(ChartsTest, ChartClosedInUvFoldsTheFewerSide) {
  const Atlas atlas = atlas_of(closed_in_uv());
  ASSERT_EQ(atlas.charts.size(), 1U);
  EXPECT_EQ(atlas.charts[0].folds, 4U);
  SmallMesh mesh = closed_in_uv();
  // One face of the lower side is cut into three around a vertex inside it.
  const std::uint32_t inside = mesh.vertex(2, 1, -1);
  mesh.uv(0.25F, 0.0625F);
  mesh.faces.erase(mesh.faces.begin() + 1);
  mesh.face({1, 0, inside});
  mesh.face({0, 5, inside});
  mesh.face({5, 1, inside});
  EXPECT_EQ(atlas_of(mesh).charts.at(0).folds, 4U) << "six against four";
}

TEST(ChartsTest, FacesWithoutUvsAreANullChart) {
  SmallMesh mesh = grid_mesh(2, 2);
  for (FaceRecord& face : mesh.faces) {
    for (TexCoordId& t : face.t) t = kNone<TexCoordId>;
  }
  const Atlas atlas = atlas_of(mesh);
  ASSERT_EQ(atlas.charts.size(), 1U);
  EXPECT_TRUE(atlas.charts[0].null);
  EXPECT_EQ(atlas.charts[0].folds, 0U);
  EXPECT_EQ(atlas.null_faces, (FaceList{0, 1}));
}

TEST(ChartsTest, TinyAreaIsNotNull) {
  SmallMesh mesh = two_charts();
  mesh.texcoords[4] = {0, 0};
  mesh.texcoords[5] = {0x1p-60F, 0};
  mesh.texcoords[6] = {0, 0x1p-60F};
  const Atlas atlas = atlas_of(mesh);
  ASSERT_EQ(atlas.charts.size(), 2U);
  EXPECT_FALSE(atlas.charts[1].null);
  EXPECT_TRUE(atlas.null_faces.empty());
}

TEST(ChartsTest, CancellingAreasAreNotNull) {
  SmallMesh mesh = grid_mesh(2, 2);
  mesh.texcoords[3] = mesh.texcoords[0];  // the second face folded onto the first
  const Atlas atlas = atlas_of(mesh);
  ASSERT_EQ(atlas.charts.size(), 1U);
  EXPECT_FALSE(atlas.charts[0].null);
  EXPECT_EQ(atlas.charts[0].folds, 1U);
}

// Two charts without area whose faces take turns.
TEST(ChartsTest, NullFacesAreThoseOfTheChart) {
  SmallMesh mesh;
  for (const std::uint32_t first : {0U, 4U}) {
    for (const auto& [x, y] : {std::pair(0, 0), {1, 0}, {0, 1}, {1, 1}}) {
      mesh.vertex(x + first, y);
      mesh.uv(static_cast<float>(x) + static_cast<float>(first),
              first == 0 ? 0 : 0.5F * static_cast<float>(y));
    }
  }
  mesh.face({0, 1, 2});
  mesh.face({4, 5, 6});
  mesh.face({1, 3, 2});
  mesh.face({5, 7, 6});
  const Atlas atlas = atlas_of(mesh);
  ASSERT_EQ(atlas.charts.size(), 2U);
  EXPECT_EQ(atlas.null_faces, (FaceList{0, 2}));
}

TEST(ChartsTest, MoebiusChartIsNotOrientableAndKeepsItsFaces) {
  SmallMesh mesh = moebius_strip(3);
  for (const TexCoord& t : {TexCoord{0, 0}, {0, 1}, {0.5F, 0}, {0.5F, 1}, {1, 0}, {1, 1}}) {
    mesh.texcoords.push_back(t);
  }
  for (FaceRecord& face : mesh.faces) {
    for (int k = 0; k < 3; ++k) face.t[k] = TexCoordId{raw(face.v[k])};
  }
  TestEngine engine;
  const Stages stages(engine, mesh);
  std::uint64_t positive = 0, negative = 0;
  double total = 0;
  for (const Triangle& triangle : stages.triangles) {
    total += triangle.area_uv;
    ++(triangle.area_uv > 0 ? positive : negative);
  }
  const Atlas atlas = atlas_of(mesh);
  ASSERT_EQ(atlas.charts.size(), 1U);
  EXPECT_FALSE(atlas.charts[0].orientable);
  EXPECT_EQ(atlas.charts[0].folds,
            total == 0 ? std::min(positive, negative) : (total > 0 ? negative : positive));
}

TEST(ChartsTest, WeldedDegenerateFaceIsInNoChart) {
  SmallMesh mesh = grid_mesh(2, 2);
  mesh.positions.push_back(mesh.positions[0]);
  mesh.face({0, 4, 1}, {0, 0, 1});
  const Atlas atlas = atlas_of(mesh);
  ASSERT_EQ(atlas.charts.size(), 1U);
  EXPECT_EQ(atlas.charts[0].faces, 2U);
}

TEST(ChartsTest, WeldedSeamWithEqualUvsIsOneChart) {
  SmallMesh mesh = grid_mesh(2, 2);
  mesh.positions.push_back(mesh.positions[1]);
  mesh.positions.push_back(mesh.positions[2]);
  mesh.faces[1].v[0] = VertexId{4};
  mesh.faces[1].v[2] = VertexId{5};
  EXPECT_EQ(atlas_of(mesh).charts.size(), 1U);
}

TEST(ChartsTest, EdgeOfThreeFacesJoinsTheChartButNotTheDirections) {
  SmallMesh mesh = book(3);
  for (int i = 0; i < 5; ++i) mesh.uv(0.2F * static_cast<float>(i), i % 2 == 0 ? 0.0F : 0.5F);
  for (FaceRecord& face : mesh.faces) {
    for (int k = 0; k < 3; ++k) face.t[k] = TexCoordId{raw(face.v[k])};
  }
  const Atlas atlas = atlas_of(mesh);
  ASSERT_EQ(atlas.charts.size(), 1U);
  EXPECT_EQ(atlas.charts[0].faces, 3U);
  EXPECT_TRUE(atlas.charts[0].orientable);
}

TEST(SeamsTest, SeamBetweenTwoCharts) {
  const Atlas atlas = atlas_of(two_charts());
  ASSERT_EQ(atlas.charts.size(), 2U);
  ASSERT_EQ(atlas.seams.size(), 1U);
  EXPECT_EQ(atlas.seams[0].length_3d, std::sqrt(2.0));
  EXPECT_TRUE(atlas.seams[0].sampled);
}

TEST(SeamsTest, SeamInsideOneChartCounts) {
  // A closed fan, cut open in UV along one spoke.
  SmallMesh mesh = fan(5, true);
  mesh.uv(0.5F, 0.5F);
  for (int i = 0; i < 6; ++i) {
    mesh.uv(0.5F + 0.4F * std::cos(static_cast<float>(i)),
            0.5F + 0.4F * std::sin(static_cast<float>(i)));
  }
  for (std::uint32_t i = 0; i < 5; ++i) {
    mesh.faces[i].t[0] = TexCoordId{0};
    mesh.faces[i].t[1] = TexCoordId{1 + i};
    mesh.faces[i].t[2] = TexCoordId{2 + i};
  }
  const Atlas atlas = atlas_of(mesh);
  EXPECT_EQ(atlas.charts.size(), 1U);
  EXPECT_EQ(atlas.seams.size(), 1U);
}

TEST(SeamsTest, EdgeToANullChartIsNoSeam) {
  SmallMesh mesh = two_charts();
  for (TexCoordId& t : mesh.faces[1].t) t = kNone<TexCoordId>;
  const Atlas atlas = atlas_of(mesh);
  EXPECT_EQ(atlas.null_faces, (FaceList{1}));
  EXPECT_TRUE(atlas.seams.empty());
}

class ChartsBudgetTest : public testing::TestWithParam<std::tuple<std::uint64_t, std::size_t>> {
 protected:
  EngineOptions options() const {
    return {.budget_bytes = std::get<0>(GetParam()) << 10, .workers = std::get<1>(GetParam())};
  }
};
INSTANTIATE_TEST_SUITE_P(BudgetsAndWorkers, ChartsBudgetTest,
                         testing::Combine(testing::Values(160, 16384), testing::Values(1, 3)));

TEST_P(ChartsBudgetTest, OneLargeChart) {
  const Atlas atlas = atlas_of(grid_mesh(100, 100), options());
  ASSERT_EQ(atlas.charts.size(), 1U);
  EXPECT_EQ(atlas.charts[0].faces, 2U * 99 * 99);
  EXPECT_EQ(atlas.charts[0].folds, 0U);
}

TEST_P(ChartsBudgetTest, LargeNullChartComesWithAllItsFaces) {
  SmallMesh mesh = grid_mesh(100, 100);
  for (TexCoord& t : mesh.texcoords) t.v = 0;
  const Atlas atlas = atlas_of(mesh, options());
  ASSERT_EQ(atlas.charts.size(), 1U);
  EXPECT_TRUE(atlas.charts[0].null);
  ASSERT_EQ(atlas.null_faces.size(), mesh.faces.size());
  EXPECT_EQ(atlas.null_faces.back(), mesh.faces.size() - 1);
}

// Every face is a part of its own, so the group of a chart is larger than the smaller budget.
TEST_P(ChartsBudgetTest, LargeNullChartsThatTakeTurns) {
  SmallMesh mesh = grid_mesh(100, 100);
  for (TexCoord& t : mesh.texcoords) t.v = 0;
  const auto vertices = static_cast<std::uint32_t>(mesh.positions.size());
  for (std::uint32_t i = 0; i < vertices; ++i) {
    const Position at = mesh.positions[i];
    mesh.vertex(at.x, at.y, at.z + 1);
    mesh.uv(mesh.texcoords[i].u, 1);
  }
  std::vector<FaceRecord> faces;
  for (const FaceRecord& face : mesh.faces) {
    faces.push_back(face);
    faces.push_back(face);
    for (VertexId& v : faces.back().v) v = VertexId{raw(v) + vertices};
    for (TexCoordId& t : faces.back().t) t = TexCoordId{raw(t) + vertices};
  }
  mesh.faces = std::move(faces);
  const Atlas atlas = atlas_of(mesh, options());
  ASSERT_EQ(atlas.charts.size(), 2U);
  EXPECT_EQ(atlas.charts[1].faces, 2U * 99 * 99);
  EXPECT_EQ(atlas.charts[1].area_3d, 99.0 * 99.0);
  ASSERT_EQ(atlas.null_faces.size(), mesh.faces.size());
  EXPECT_EQ(atlas.null_faces.back(), mesh.faces.size() - 1);
}

TEST_P(ChartsBudgetTest, EveryFaceAChart) {
  SmallMesh mesh = grid_mesh(80, 80);
  mesh.texcoords.clear();
  for (std::size_t i = 0; i < mesh.faces.size(); ++i) {
    const float u = static_cast<float>(i) / 20000;
    for (TexCoordId& t : mesh.faces[i].t) {
      const bool last = &t == &mesh.faces[i].t[2];
      t = TexCoordId{mesh.uv(u + (last ? 0.00001F : 0.0F), &t == mesh.faces[i].t ? 0.0F : 0.5F)};
    }
  }
  const Atlas atlas = atlas_of(mesh, options());
  EXPECT_EQ(atlas.charts.size(), mesh.faces.size());
  EXPECT_EQ(atlas.seams.size(), 3U * 79 * 79 - 2 * 79);
}

}  // namespace
}  // namespace atlasgauge
