#include "stream/engine/last_uses.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>

#include "stream/engine/budget.hpp"

namespace atlasgauge {
namespace {

TEST(LastUsesTest, KeyIsInUseUntilTheLastItemThatNamesIt) {
  MemoryBudget budget(1 << 20);
  LastUses uses(budget);
  uses.note(5, 1);
  uses.note(7, 2);
  uses.note(5, 3);
  EXPECT_EQ(uses.keys_per_range(), 1U);
  EXPECT_EQ(uses.items_until_unused(5), 3U);
  EXPECT_EQ(uses.items_until_unused(7), 2U);
}

TEST(LastUsesTest, KeyThatNoneNamesIsNeverInUse) {
  MemoryBudget budget(1 << 20);
  LastUses uses(budget);
  uses.note(5, 1);
  EXPECT_EQ(uses.items_until_unused(4), 0U);
  EXPECT_EQ(uses.items_until_unused(4000000000U), 0U);
}

TEST(LastUsesTest, RangesWidenToTheLatestOfTheirKeys) {
  MemoryBudget budget(1 << 20);
  LastUses uses(budget, 4);
  for (std::uint32_t key = 0; key < 4; ++key) uses.note(key, 10 + key);
  uses.note(4, 20);
  EXPECT_EQ(uses.keys_per_range(), 2U);
  EXPECT_EQ(uses.items_until_unused(0), 11U);
  EXPECT_EQ(uses.items_until_unused(1), 11U);
  EXPECT_EQ(uses.items_until_unused(2), 13U);
  EXPECT_EQ(uses.items_until_unused(5), 20U);
  EXPECT_EQ(uses.items_until_unused(6), 0U);
}

TEST(LastUsesTest, AnyKeyHasARange) {
  MemoryBudget budget(64 << 20);
  LastUses uses(budget);
  uses.note(3, 1);
  uses.note(~std::uint32_t{0}, 2);
  EXPECT_EQ(uses.keys_per_range(), 1U << 16);
  EXPECT_EQ(uses.items_until_unused(3), 1U);
  EXPECT_EQ(uses.items_until_unused(~std::uint32_t{0}), 2U);
}

TEST(LastUsesTest, AnswersAreUpperBoundsHoweverFewTheRanges) {
  MemoryBudget budget(1 << 20);
  LastUses uses(budget, 16);
  std::map<std::uint32_t, std::uint32_t> exact;
  std::mt19937 random(1);
  for (std::uint32_t item = 1; item <= 2000; ++item) {
    const std::uint32_t key = static_cast<std::uint32_t>(random() % 5000);
    uses.note(key, item);
    exact[key] = item;
  }
  for (const auto& [key, item] : exact) EXPECT_GE(uses.items_until_unused(key), item);
}

TEST(LastUsesTest, TakesASmallPartOfASmallBudget) {
  MemoryBudget budget(64 << 10);
  const LastUses uses(budget);
  EXPECT_EQ(budget.peak_bytes(), 1U << 10);
}

TEST(LastUsesTest, LateIsWhatEndsWithMostItemsPassed) {
  MemoryBudget budget(1 << 20);
  LastUses in_order(budget), backwards(budget), late(budget);
  for (std::uint32_t i = 0; i < 100; ++i) {
    in_order.note(i, i + 1);
    backwards.note(99 - i, i + 1);
    late.note(i, 901 + i);
  }
  EXPECT_FALSE(in_order.are_late());
  EXPECT_FALSE(backwards.are_late());
  EXPECT_TRUE(late.are_late());
  EXPECT_FALSE(LastUses().are_late());
}

}  // namespace
}  // namespace atlasgauge
