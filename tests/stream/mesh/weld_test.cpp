#include "stream/mesh/weld.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <tuple>
#include <vector>

#include "tests/stream/mesh/small_mesh.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

using Positions = std::vector<Position>;
using Indices = std::vector<std::uint32_t>;

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr double kInf = std::numeric_limits<double>::infinity();

/// The welded vertex of every vertex, whether or not there is a table.
Indices welded(TestEngine& engine, const Positions& positions) {
  SmallMesh small;
  small.positions = positions;
  MeshStore mesh = small.store(engine);
  Weld weld = weld_vertices(engine, mesh);
  Indices table;
  for (const VertexId v : records_of(weld.welded)) table.push_back(raw(v));
  EXPECT_EQ(weld.found_any(), !table.empty());
  std::uint64_t duplicates = 0;
  for (std::uint32_t v = 0; v < table.size(); ++v) duplicates += table[v] == v ? 0 : 1;
  EXPECT_EQ(weld.duplicates, duplicates);
  EXPECT_EQ(records_of(mesh.positions).size(), positions.size()) << "positions are kept";
  for (auto v = static_cast<std::uint32_t>(table.size()); v < positions.size(); ++v) {
    table.push_back(v);
  }
  return table;
}

Indices naive(const Positions& positions) {
  std::map<std::tuple<double, double, double>, std::uint32_t> first;
  Indices table;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const auto [x, y, z] = positions[v];
    const bool nan = std::isnan(x) || std::isnan(y) || std::isnan(z);
    table.push_back(nan ? v : first.emplace(std::tuple(x, y, z), v).first->second);
  }
  return table;
}

/// From all in memory to the smallest that works, in which large buckets overflow again and again.
class WeldTest : public testing::TestWithParam<std::tuple<std::uint64_t, std::size_t>> {
 protected:
  void expect_welded(const Positions& positions) {
    const auto [kib, workers] = GetParam();
    TestEngine engine({.budget_bytes = kib << 10, .workers = workers});
    EXPECT_EQ(welded(engine, positions), naive(positions));
    EXPECT_EQ(engine.budget.free_bytes(), engine.budget.limit_bytes());
  }
};
INSTANTIATE_TEST_SUITE_P(BudgetsAndWorkers, WeldTest,
                         testing::Combine(testing::Values(32, 64, 300, 16384),
                                          testing::Values(1, 2, 3)));

TEST_P(WeldTest, NoPositions) {
  expect_welded({});
}

TEST_P(WeldTest, DistinctPositionsHaveNoTable) {
  Positions positions;
  for (int i = 0; i < 5000; ++i) positions.push_back({static_cast<double>(i), 0, 0});
  expect_welded(positions);
}

TEST_P(WeldTest, AnyCoordinateTellsApart) {
  expect_welded({{1, 2, 3}, {1, 3, 2}, {3, 2, 1}, {1, 2, 4}, {1, 4, 3}, {4, 2, 3}, {1, 2, 3}});
}

TEST_P(WeldTest, AllPositionsEqual) {
  expect_welded(Positions(10000, {1, 2, 3}));
}

TEST_P(WeldTest, EveryPositionTwiceFarApart) {
  Positions positions;
  for (int i = 0; i < 10000; ++i) positions.push_back({0.1 * (i % 5000), 1, 0});
  expect_welded(positions);
}

TEST_P(WeldTest, ManyPositionsAtRandom) {
  std::mt19937 random(4);
  std::uniform_int_distribution<int> coordinate(0, 15);
  Positions positions;
  for (int i = 0; i < 12000; ++i) {
    positions.push_back(
        {coordinate(random) / 8.0, coordinate(random) / 8.0, coordinate(random) / 8.0});
  }
  expect_welded(positions);
}

TEST_P(WeldTest, NaNEqualsNothing) {
  expect_welded({{kNaN, 0, 0}, {kNaN, 0, 0}, {0, kNaN, 0}, {0, kNaN, 0}, {0, 0, 1}, {0, 0, 1}});
}

TEST_P(WeldTest, InfinitiesAreEqual) {
  expect_welded({{kInf, 0, 0}, {-kInf, 0, 0}, {kInf, 0, 0}, {0, kInf, 0}});
}

TEST(WeldHandTest, SmallestVertexStandsForAll) {
  TestEngine engine;
  EXPECT_EQ(welded(engine, {{9, 9, 9}, {1, 1, 1}, {2, 2, 2}, {1, 1, 1}, {9, 9, 9}, {1, 1, 1}}),
            (Indices{0, 1, 2, 1, 0, 1}));
}

}  // namespace
}  // namespace atlasgauge
