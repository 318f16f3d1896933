#include "stream/mesh/cracks.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/stream/mesh/stages.hpp"

namespace atlasgauge {
namespace {

/// Boundary edges, each with vertices and a face of its own.
class CracksTest : public ::testing::Test {
 protected:
  /// A part of edges to come.
  void part(double step) { parts_.push_back({edges_.size(), step}); }
  void edge(const Position& a, const Position& b) {
    const auto v = static_cast<std::uint32_t>(vertices_.size());
    vertices_.push_back(a);
    vertices_.push_back(b);
    edges_.push_back({{VertexId{v}, VertexId{v + 1}}, FaceId{v / 2}});
  }

  /// Lengths of the cracks, ascending.
  std::vector<double> cracks(const EngineOptions& options = {}) {
    TestEngine engine(options);
    GroupCollector groups;
    Spill<Position> vertices = spill_of(engine, vertices_);
    find_cracks(engine, spill_of(engine, edges_), vertices, parts_, groups);
    std::vector<double> lengths;
    for (const CrackEdge& crack : groups.cracks) lengths.push_back(crack.length_3d);
    std::ranges::sort(lengths);
    return lengths;
  }

  std::vector<Position> vertices_;
  std::vector<OpenEdge> edges_;
  std::vector<PartStart> parts_;
};

using Lengths = std::vector<double>;

TEST_F(CracksTest, EdgesWithinAStepOfEachOtherAreCracksBoth) {
  part(0.1);
  edge({0, 0, 0}, {1, 0, 0});
  part(0.1);
  edge({0, 0.1, 0}, {1, 0.1, 0});
  EXPECT_EQ(cracks(), (Lengths{1, 1}));
}

TEST_F(CracksTest, TheStepCountsInEachCoordinate) {
  part(0.1);
  edge({0, 0, 0}, {2, 0, 0});
  part(0.1);
  edge({0.1, 0.1, 0.1}, {1.9, 0.1, 0.1});
  EXPECT_EQ(cracks().size(), 2U) << "0.17 away, but 0.1 in each";
}

TEST_F(CracksTest, EdgesFurtherApartAreNot) {
  part(0.1);
  edge({0, 0, 0}, {1, 0, 0});
  part(0.1);
  edge({0, 0.101, 0}, {1, 0.101, 0});
  EXPECT_TRUE(cracks().empty());
}

TEST_F(CracksTest, EdgesOfTheSamePartAreNot) {
  part(0.1);
  edge({0, 0, 0}, {1, 0, 0});
  edge({0, 0.05, 0}, {1, 0.05, 0});
  part(0.1);
  edge({5, 5, 5}, {6, 5, 5});
  EXPECT_TRUE(cracks().empty());
}

TEST_F(CracksTest, TheLargerStepDecides) {
  part(0.01);
  edge({0, 0, 0}, {1, 0, 0});
  part(0.2);
  edge({0, 0.1, 0}, {1, 0.1, 0});
  EXPECT_EQ(cracks().size(), 2U);
}

TEST_F(CracksTest, PartsThatQuantizeNothingMayLieAsTheyLie) {
  part(0);
  edge({0, 0, 0}, {1, 0, 0});
  part(0);
  edge({0, 0, 0}, {1, 0, 0});
  part(0.1);
  edge({9, 0, 0}, {8, 0, 0});
  EXPECT_TRUE(cracks().empty());
}

TEST_F(CracksTest, AnEdgeThatTouchesWithOneEndIsNone) {
  part(0.1);
  edge({0, 0, 0}, {1, 0, 0});
  part(0.1);
  edge({1, 0, 0}, {1, 1, 0});
  EXPECT_TRUE(cracks().empty());
}

TEST_F(CracksTest, AnEdgeWhoseMiddleIsApartIsNone) {
  part(0.1);
  edge({0, 0, 0}, {2, 0, 0});
  part(0.1);
  edge({0, 0, 0}, {1, 1, 0});
  edge({1, 1, 0}, {2, 0, 0});
  EXPECT_TRUE(cracks().empty());
}

TEST_F(CracksTest, ALongEdgeMayLieAtShortOnesOfSeveralParts) {
  part(0.1);
  edge({0, 0, 0}, {2, 0, 0});
  part(0.1);
  edge({0, 0.05, 0}, {0.75, 0.05, 0});
  part(0.1);
  edge({0.75, 0.05, 0}, {2, 0.05, 0});
  EXPECT_EQ(cracks(), (Lengths{0.75, 1.25, 2}));
}

TEST_F(CracksTest, LengthsOfAllSizesMeet) {
  part(1e-3);
  edge({0, 0, 0}, {1e6, 0, 0});
  part(1e-3);
  for (const double x : {0.0, 1e3, 999999.5, -3.0}) edge({x, 0, 0}, {x + 0.25, 0, 0});
  EXPECT_EQ(cracks(), (Lengths{0.25, 0.25, 0.25}));
}

TEST_F(CracksTest, RoundingOfLargeCoordinatesIsForgiven) {
  const float far = 1e6;
  const float next = std::nextafter(far, 2 * far);
  part(1e-6);
  edge({far, 0, 0}, {far, 1, 0});
  part(1e-6);
  edge({next, 0, 0}, {next, 1, 0});
  EXPECT_EQ(cracks().size(), 2U);
}

TEST_F(CracksTest, EdgesOfNoLengthAndOfHugeOneAreLookedAt) {
  part(0.5);
  edge({1e300, 0, 0}, {-1e300, 0, 0});
  edge({3, 3, 3}, {3, 3, 3});
  part(0.5);
  edge({3, 3, 3.25}, {3, 3, 3.25});
  EXPECT_EQ(cracks(), (Lengths{0, 0}));
}

/// The same by comparing every point with every edge, at many places along it.
std::size_t cracks_by_trial(const std::vector<Position>& p, const std::vector<OpenEdge>& edges,
                            const std::vector<std::uint32_t>& part_of, double step) {
  const auto at = [](const Position& a, const Position& b, double t) {
    return Position{a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
  };
  const auto near = [&](const Position& q, std::size_t edge) {
    for (int i = 0; i <= 2000; ++i) {
      const Position s = at(p[raw(edges[edge].v[0])], p[raw(edges[edge].v[1])], i / 2000.0);
      if (std::max({std::abs(s.x - q.x), std::abs(s.y - q.y), std::abs(s.z - q.z)}) <= step) {
        return true;
      }
    }
    return false;
  };
  std::size_t count = 0;
  for (std::size_t e = 0; e < edges.size(); ++e) {
    bool whole = true;
    for (const double t : {0.0, 0.5, 1.0}) {
      const Position q = at(p[raw(edges[e].v[0])], p[raw(edges[e].v[1])], t);
      bool found = false;
      for (std::size_t other = 0; other < edges.size() && !found; ++other) {
        found = part_of[other] != part_of[e] && near(q, other);
      }
      whole = whole && found;
    }
    count += whole;
  }
  return count;
}

TEST_F(CracksTest, AgreesWithComparingAllWithAllInAnyMemory) {
  std::mt19937 random(7);
  const auto fraction = [&] { return static_cast<double>(random()) * 0x1p-32; };
  std::vector<std::uint32_t> part_of;
  for (std::uint32_t i = 0; i < 4; ++i) {
    part(0.05);
    for (int k = 0; k < 40; ++k) {
      const Position a{fraction(), fraction(), 0.1 * fraction()};
      const double length = std::ldexp(1, -static_cast<int>(random() % 6));
      edge(a, {a.x + length * (fraction() - 0.5), a.y + length * (fraction() - 0.5), a.z});
      part_of.push_back(i);
    }
  }
  const std::size_t expected = cracks_by_trial(vertices_, edges_, part_of, 0.05);
  EXPECT_GT(expected, 10U);
  EXPECT_LT(expected, 150U);
  const Lengths all = cracks();
  EXPECT_EQ(all.size(), expected);
  EXPECT_EQ(cracks({.budget_bytes = 1 << 20, .workers = 3}), all);
}

TEST_F(CracksTest, APlaceWithMoreEdgesThanMemoryIsSearchedInPieces) {
  for (int i = 0; i < 3; ++i) {
    part(0.1);
    for (int k = 0; k < 4000; ++k) edge({0, 0, 0}, {1, 0, 0});
  }
  part(0.1);
  for (int k = 0; k < 4000; ++k) edge({0, 5, 0}, {1, 5, 0});
  EXPECT_EQ(cracks({.budget_bytes = 512 << 10}).size(), 12000U);
}

}  // namespace
}  // namespace atlasgauge
