#include "stream/seams/located_seams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

SeamEdge edge_of(std::uint32_t from, std::uint32_t to) {
  SeamEdge edge;
  edge.v[0] = VertexId{from};
  edge.v[1] = VertexId{to};
  edge.length_3d = from + to / 1000.0;
  return edge;
}

std::vector<Position> vertices(std::uint32_t count) {
  std::vector<Position> positions(count);
  for (std::uint32_t i = 0; i < count; ++i) positions[i] = {i + 0.25, -1.0 * i, i / 3.0};
  return positions;
}

std::vector<LocatedSeam> all_of(LocatedSeams& seams) {
  std::vector<LocatedSeam> rows;
  for (LocatedSeam seam; seams.read(seam);) rows.push_back(seam);
  return rows;
}

TEST(LocatedSeamsTest, ComeInTheOrderOfTheirVerticesWithTheirPositions) {
  TestEngine engine;
  const Spill<Position> positions = spill_of(engine, vertices(10));
  LocatedSeams seams(engine,
                     spill_of(engine, std::vector{edge_of(4, 9), edge_of(1, 8), edge_of(4, 5)}),
                     positions);
  EXPECT_EQ(seams.count(), 3U);
  const std::vector<LocatedSeam> rows = all_of(seams);
  ASSERT_EQ(rows.size(), 3U);
  const std::vector<std::pair<std::uint32_t, std::uint32_t>> want{{1, 8}, {4, 5}, {4, 9}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto [from, to] = want[i];
    EXPECT_EQ(rows[i].edge.v[0], VertexId{from});
    EXPECT_EQ(rows[i].edge.v[1], VertexId{to});
    EXPECT_EQ(rows[i].edge.length_3d, from + to / 1000.0);
    EXPECT_EQ(rows[i].p[0].x, from + 0.25);
    EXPECT_EQ(rows[i].p[1].y, -1.0 * to);
  }
}

TEST(LocatedSeamsTest, NoneAreNone) {
  TestEngine engine;
  const Spill<Position> positions = spill_of(engine, vertices(3));
  LocatedSeams seams(engine, spill_of(engine, std::vector<SeamEdge>{}), positions);
  LocatedSeam seam;
  EXPECT_EQ(seams.count(), 0U);
  EXPECT_FALSE(seams.read(seam));
}

TEST(LocatedSeamsTest, EveryPositionIsFoundInAnyMemory) {
  constexpr std::uint32_t kVertices = 20'000;
  std::mt19937 random(3);
  std::uniform_int_distribution<std::uint32_t> vertex(0, kVertices - 1);
  std::vector<SeamEdge> edges;
  for (std::uint32_t i = 0; i < 5000; ++i) {
    const std::uint32_t a = vertex(random), b = vertex(random);
    edges.push_back(edge_of(std::min(a, b), std::max(a, b)));
  }
  for (const std::uint64_t budget : {std::uint64_t{80'000}, std::uint64_t{64} << 20}) {
    TestEngine engine({.budget_bytes = budget});
    const Spill<Position> positions = spill_of(engine, vertices(kVertices));
    LocatedSeams seams(engine, spill_of(engine, edges), positions);
    const std::vector<LocatedSeam> rows = all_of(seams);
    ASSERT_EQ(rows.size(), edges.size());
    for (const LocatedSeam& row : rows) {
      for (int end = 0; end < 2; ++end) {
        ASSERT_EQ(row.p[end].y, -1.0 * raw(row.edge.v[end]));
        ASSERT_EQ(row.p[end].z, raw(row.edge.v[end]) / 3.0);
      }
    }
  }
}

}  // namespace
}  // namespace atlasgauge
