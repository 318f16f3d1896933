#include "stream/mesh/face_stream.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <random>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "tests/stream/mesh/small_mesh.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

/// 40000 vertices (960 kB) and as many UVs (320 kB), 79202 faces.
SmallMesh large_grid() {
  return grid_mesh(200, 200);
}

void shuffle_faces(SmallMesh& mesh, std::ptrdiff_t first = 0) {
  std::shuffle(mesh.faces.begin() + first, mesh.faces.end(), std::mt19937(1));
}

/// Every third face has a corner without UV, or with one that is not finite.
void lose_some_uvs(SmallMesh& mesh) {
  const std::uint32_t broken = mesh.uv(NAN, 0);
  for (std::size_t i = 0; i < mesh.faces.size(); i += 3) {
    mesh.faces[i].t[i % 2] = TexCoordId{i % 2 == 0 ? kNoUv : broken};
  }
}

/// The last row lies where the first does.
void make_duplicates(SmallMesh& mesh) {
  for (std::size_t i = 0; i < 200; ++i) mesh.positions[39800 + i] = mesh.positions[i];
}

bool same(const TexCoord& a, const TexCoord& b) {
  return bits_of(a) == bits_of(b);
}

/// Checks every face where it is handed out, and that commit comes in face order.
void expect_joined(TestEngine& engine, const SmallMesh& small, std::uint64_t memory_bytes,
                   bool first_row_twice = false,
                   SpillReader<FaceRecord>::Mode mode = SpillReader<FaceRecord>::Mode::kKeep) {
  MeshStore mesh = small.store(engine);
  Weld weld = weld_vertices(engine, mesh);
  StageLog::Stage stage(engine.log, "faces");
  std::vector<std::uint64_t> first(engine.workers.count()), count(engine.workers.count());
  std::atomic<std::uint64_t> wrong{0};
  std::uint64_t committed = 0;
  FaceVisitor visitor;
  visitor.transform = [&](std::size_t worker, std::uint64_t first_face,
                          std::span<const JoinedFace> faces) {
    if (count[worker] == 0) first[worker] = first_face;
    if (first_face != first[worker] + count[worker]) ++wrong;
    count[worker] += faces.size();
    for (std::size_t i = 0; i < faces.size(); ++i) {
      const JoinedFace& face = faces[i];
      const FaceRecord& record = small.faces[first_face + i];
      for (int k = 0; k < 3; ++k) {
        const std::uint32_t v = raw(record.v[k]), t = raw(record.t[k]);
        const std::uint32_t w = first_row_twice && v >= 39800 ? v - 39800 : v;
        const Position& p = small.positions[v];
        const bool has_uv = t < small.texcoords.size() && is_finite(small.texcoords[t]);
        const bool right = raw(face.record.v[k]) == v && raw(face.welded[k]) == w &&
                           face.p[k].x == p.x && face.p[k].y == p.y && face.p[k].z == p.z &&
                           same(face.t[k], has_uv ? small.texcoords[t] : kNoTexCoord);
        if (!right) ++wrong;
      }
    }
  };
  visitor.commit = [&](std::size_t worker) {
    EXPECT_EQ(first[worker], committed);
    committed += std::exchange(count[worker], 0);
  };
  visit_faces(engine, mesh, weld, mode, memory_bytes, stage, visitor);
  EXPECT_EQ(committed, small.faces.size());
  EXPECT_EQ(wrong, 0U);
}

class FaceStreamTest : public testing::TestWithParam<std::size_t> {
 protected:
  FaceStreamTest() { lose_some_uvs(mesh_); }
  EngineOptions options(std::uint64_t budget_bytes) const {
    return {.budget_bytes = budget_bytes, .workers = GetParam()};
  }
  SmallMesh mesh_ = large_grid();
};
INSTANTIATE_TEST_SUITE_P(Workers, FaceStreamTest, testing::Values(1, 3));

TEST_P(FaceStreamTest, LoadedTables) {
  TestEngine engine(options(4 << 20));
  expect_joined(engine, mesh_, 2 << 20);
  EXPECT_GT(engine.budget.peak_bytes(), 960000U);
}

TEST_P(FaceStreamTest, PageCachesForNeighbouringIndices) {
  TestEngine engine(options(GetParam() * (600 << 10)));
  const std::uint64_t memory_bytes = GetParam() * (300 << 10);
  expect_joined(engine, mesh_, memory_bytes);
  EXPECT_EQ(engine.budget.free_bytes(), engine.budget.limit_bytes());
}

TEST_P(FaceStreamTest, GatheredCornersForScatteredIndices) {
  shuffle_faces(mesh_);
  TestEngine engine(options(GetParam() * (200 << 10)));
  expect_joined(engine, mesh_, GetParam() * (100 << 10));
}

TEST_P(FaceStreamTest, CachesAreLeftInTheMiddle) {
  shuffle_faces(mesh_, 40000);
  TestEngine engine(options(GetParam() * (600 << 10)));
  expect_joined(engine, mesh_, GetParam() * (300 << 10), false,
                SpillReader<FaceRecord>::Mode::kConsume);
}

TEST_P(FaceStreamTest, WeldedVerticesByEveryWay) {
  make_duplicates(mesh_);
  TestEngine loaded(options(4 << 20)), cached(options(GetParam() * (600 << 10)));
  expect_joined(loaded, mesh_, 2 << 20, true);
  expect_joined(cached, mesh_, GetParam() * (300 << 10), true);
  shuffle_faces(mesh_);
  TestEngine gathered(options(GetParam() * (200 << 10)));
  expect_joined(gathered, mesh_, GetParam() * (100 << 10), true);
}

TEST_P(FaceStreamTest, MeshWithoutUvs) {
  mesh_.texcoords.clear();
  TestEngine loaded(options(4 << 20)), cached(options(GetParam() * (600 << 10)));
  expect_joined(loaded, mesh_, 2 << 20);
  expect_joined(cached, mesh_, GetParam() * (300 << 10));
  shuffle_faces(mesh_);
  TestEngine gathered(options(GetParam() * (200 << 10)));
  expect_joined(gathered, mesh_, GetParam() * (100 << 10));
}

TEST_P(FaceStreamTest, NoFaces) {
  TestEngine engine(options(1 << 20));
  expect_joined(engine, SmallMesh{}, 1 << 18);
}

/// What tells the three ways apart: reads of scratch against what the tables and faces hold.
TEST(FaceStreamWaysTest, ScatteredFacesAreGatheredNotRead) {
  SmallMesh mesh = large_grid();
  shuffle_faces(mesh);
  TestEngine engine({.budget_bytes = 200 << 10, .workers = 1});
  expect_joined(engine, mesh, 100 << 10);
  // 237606 corners, each a read of a page of 12 kB or more if they were looked up one by one.
  EXPECT_LT(engine.scratch.read_bytes(), 200U << 20);
  EXPECT_GT(engine.scratch.written_bytes(), 10U << 20);
}

TEST(FaceStreamWaysTest, NeighbouringFacesAreReadNotGathered) {
  TestEngine engine({.budget_bytes = 600 << 10, .workers = 1});
  expect_joined(engine, large_grid(), 300 << 10);
  EXPECT_LT(engine.scratch.written_bytes(), 8U << 20);
}

// Of the 79202 faces, those that the caches served are not gathered.
TEST(FaceStreamWaysTest, OnlyFacesFromTheMiddleOnAreGathered) {
  std::uint64_t written[2];
  for (const int way : {0, 1}) {
    SmallMesh mesh = large_grid();
    shuffle_faces(mesh, way * 40000);
    TestEngine engine({.budget_bytes = 600 << 10, .workers = 1});
    expect_joined(engine, mesh, 300 << 10);
    EXPECT_LT(engine.scratch.read_bytes(), 2U * 79202 * 600);
    written[way] = engine.scratch.written_bytes();
  }
  EXPECT_LT(written[1], written[0] / 3 * 2);
}

TEST(FaceStreamErrorTest, ErrorOfAVisitorIsThrown) {
  TestEngine engine;
  MeshStore mesh = grid_mesh(20, 20).store(engine);
  Weld weld = weld_vertices(engine, mesh);
  StageLog::Stage stage(engine.log, "faces");
  FaceVisitor visitor;
  visitor.transform = [](std::size_t, std::uint64_t, std::span<const JoinedFace>) {
    throw std::runtime_error("bad face");
  };
  EXPECT_THROW(visit_faces(engine, mesh, weld, SpillReader<FaceRecord>::Mode::kKeep, 1 << 20, stage,
                           visitor),
               std::runtime_error);
}

}  // namespace
}  // namespace atlasgauge
