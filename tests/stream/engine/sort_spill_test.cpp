#include "stream/engine/sort_spill.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "io/error.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

using Numbers = std::vector<std::uint32_t>;

Numbers random_numbers(std::size_t count, std::uint32_t below) {
  std::mt19937 random(static_cast<unsigned>(count));
  std::uniform_int_distribution<std::uint32_t> number(0, below - 1);
  Numbers numbers(count);
  for (std::uint32_t& n : numbers) n = number(random);
  return numbers;
}

Numbers sorted_by(TestEngine& engine, const Numbers& numbers) {
  return records_of(sort_spill(engine, spill_of(engine, numbers), std::less<>()));
}

/// A budget of five blocks: runs of three blocks (3072 numbers), four merged at a time.
constexpr std::uint64_t kLeast = 5 * 4096;

TEST(SortSpillTest, SortsAtEveryMergeDepth) {
  // 1 run; 2; 4 in one level; 5 in two; 17 in three.
  for (const std::size_t count : {0U, 1U, 3072U, 3073U, 12288U, 12289U, 50000U}) {
    TestEngine engine({.budget_bytes = kLeast});
    Numbers numbers = random_numbers(count, ~0U);
    const Numbers sorted = sorted_by(engine, numbers);
    std::sort(numbers.begin(), numbers.end());
    EXPECT_EQ(sorted, numbers) << count;
  }
}

TEST(SortSpillTest, EqualNumbersAreAllKept) {
  TestEngine engine({.budget_bytes = kLeast});
  Numbers numbers = random_numbers(30000, 3);
  const Numbers sorted = sorted_by(engine, numbers);
  std::sort(numbers.begin(), numbers.end());
  EXPECT_EQ(sorted, numbers);
}

TEST(SortSpillTest, TakesAnyOrder) {
  TestEngine engine({.budget_bytes = kLeast});
  Numbers numbers = random_numbers(20000, 100);
  Numbers falling = records_of(sort_spill(engine, spill_of(engine, numbers), std::greater<>()));
  std::sort(numbers.begin(), numbers.end(), std::greater<>());
  EXPECT_EQ(falling, numbers);
}

TEST(SortSpillTest, SortsInThePoolWithoutWriting) {
  TestEngine engine({.resident_bytes = 1 << 20});
  sorted_by(engine, random_numbers(50000, ~0U));
  EXPECT_EQ(engine.scratch.written_bytes(), 0U);
}

TEST(SortSpillTest, TakesNoMoreBudgetThanItCanUse) {
  TestEngine engine;
  sorted_by(engine, random_numbers(1000, ~0U));
  EXPECT_EQ(engine.budget.peak_bytes(), kLeast + 4000);
  EXPECT_EQ(engine.budget.free_bytes(), engine.budget.limit_bytes());
}

TEST(SortSpillTest, MergingFreesItsInput) {
  TestEngine engine({.budget_bytes = kLeast});
  sorted_by(engine, random_numbers(50000, ~0U));
  // 49 blocks of records; runs end in blocks of their own, and merging holds a few of both sides.
  EXPECT_LE(engine.scratch.peak_bytes(), (49 + 17 + 8) * 4096U);
}

TEST(SortSpillTest, TooLittleMemoryIsRefused) {
  TestEngine engine({.budget_bytes = kLeast - 1});
  EXPECT_THROW(sorted_by(engine, {2, 1}), Error);
}

}  // namespace
}  // namespace atlasgauge
