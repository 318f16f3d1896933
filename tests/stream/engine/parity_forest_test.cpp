#include "stream/engine/parity_forest.hpp"

#include <gtest/gtest.h>

namespace atlasgauge {
namespace {

void expect_root(ParityForest& forest, std::uint32_t node, std::uint32_t root, bool parity) {
  EXPECT_EQ(forest.find(node).node, root) << node;
  EXPECT_EQ(forest.find(node).parity, parity) << node;
}

TEST(ParityForestTest, StartsAsSingleNodes) {
  ParityForest forest(3);
  for (std::uint32_t node = 0; node < 3; ++node) {
    expect_root(forest, node, node, false);
    EXPECT_TRUE(forest.is_root(node));
    EXPECT_FALSE(forest.conflict(node));
  }
}

TEST(ParityForestTest, RootIsTheSmallestNode) {
  ParityForest forest(5);
  forest.unite(4, 3, false);
  forest.unite(3, 2, false);
  forest.unite(2, 1, false);
  for (std::uint32_t node = 1; node < 5; ++node) expect_root(forest, node, 1, false);
  expect_root(forest, 0, 0, false);
}

TEST(ParityForestTest, ParitiesAddUpAlongAPath) {
  ParityForest forest(4);
  forest.unite(0, 1, true);
  forest.unite(1, 2, true);
  forest.unite(2, 3, true);
  expect_root(forest, 1, 0, true);
  expect_root(forest, 2, 0, false);
  expect_root(forest, 3, 0, true);
}

TEST(ParityForestTest, ParityIsAgainstTheNewRootWhenSetsMeet) {
  ParityForest forest(4);
  forest.unite(2, 3, true);
  forest.unite(0, 3, false);
  expect_root(forest, 3, 0, false);
  expect_root(forest, 2, 0, true);
}

TEST(ParityForestTest, EvenCycleIsNoConflict) {
  ParityForest forest(4);
  for (std::uint32_t node = 0; node < 4; ++node) forest.unite(node, (node + 1) % 4, true);
  EXPECT_FALSE(forest.conflict(0));
}

TEST(ParityForestTest, OddCycleIsAConflict) {
  ParityForest forest(3);
  for (std::uint32_t node = 0; node < 3; ++node) forest.unite(node, (node + 1) % 3, true);
  EXPECT_TRUE(forest.conflict(0));
}

TEST(ParityForestTest, SelfLinkOfOddParityIsAConflict) {
  ParityForest forest(2);
  forest.unite(1, 1, false);
  EXPECT_FALSE(forest.conflict(1));
  forest.unite(1, 1, true);
  EXPECT_TRUE(forest.conflict(1));
  EXPECT_FALSE(forest.conflict(0));
}

TEST(ParityForestTest, ConflictGoesAlongWhenSetsMeet) {
  ParityForest forest(3);
  forest.unite(2, 2, true);
  forest.unite(1, 2, true);
  forest.unite(0, 1, false);
  EXPECT_TRUE(forest.conflict(0));
}

TEST(ParityForestTest, ConflictDoesNotSpoilParities) {
  ParityForest forest(4);
  forest.unite(1, 1, true);
  forest.unite(1, 2, true);
  forest.unite(0, 2, true);
  expect_root(forest, 1, 0, false);
  expect_root(forest, 2, 0, true);
}

TEST(ParityForestTest, LongChainKeepsParities) {
  constexpr std::uint32_t kNodes = 10000;
  ParityForest forest(kNodes);
  for (std::uint32_t node = kNodes - 1; node > 0; --node) forest.unite(node - 1, node, true);
  for (std::uint32_t node = 0; node < kNodes; ++node) {
    ASSERT_EQ(forest.find(node).node, 0U);
    ASSERT_EQ(forest.find(node).parity, node % 2 == 1);
  }
}

}  // namespace
}  // namespace atlasgauge
