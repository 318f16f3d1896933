#include "stream/engine/gather.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "io/error.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

using Indices = std::vector<std::uint32_t>;

constexpr std::uint32_t kAbsent = 12345;
constexpr std::uint64_t kLeast = 16 * 4096;

std::vector<std::uint64_t> squares(std::uint64_t count) {
  std::vector<std::uint64_t> table;
  for (std::uint64_t i = 0; i < count; ++i) table.push_back(i * i);
  return table;
}

Indices random_indices(std::size_t count, std::uint32_t below) {
  std::mt19937 random(7);
  std::uniform_int_distribution<std::uint32_t> index(0, below - 1);
  Indices indices(count);
  for (std::uint32_t& i : indices) i = index(random);
  return indices;
}

void expect_squares(TestEngine& engine, const Indices& indices, std::uint64_t table_size) {
  Spill<std::uint64_t> table = spill_of(engine, squares(table_size));
  const std::vector<std::uint64_t> values =
      records_of(gather(engine, spill_of(engine, indices), table, std::uint64_t{kAbsent}));
  ASSERT_EQ(values.size(), indices.size());
  for (std::size_t i = 0; i < indices.size(); ++i) {
    const std::uint64_t index = indices[i];
    ASSERT_EQ(values[i], index < table_size ? index * index : kAbsent) << "at " << i;
  }
  EXPECT_EQ(records_of(table), squares(table_size)) << "the table is kept";
  EXPECT_EQ(engine.budget.free_bytes(), engine.budget.limit_bytes());
}

class GatherTest : public testing::TestWithParam<std::uint64_t> {
 protected:
  TestEngine engine_{{.budget_bytes = GetParam()}};
};
// Half of the budget is for a slice: 4096 squares in the first case.
INSTANTIATE_TEST_SUITE_P(Budgets, GatherTest, testing::Values(kLeast, 3 * kLeast, 8 << 20));

TEST_P(GatherTest, AnyOrder) {
  expect_squares(engine_, random_indices(30000, 20000), 20000);
}

TEST_P(GatherTest, FewIndicesIntoALargeTable) {
  expect_squares(engine_, {19999, 0, 7}, 20000);
}

TEST_P(GatherTest, ManyIndicesIntoASmallTable) {
  expect_squares(engine_, random_indices(30000, 3), 3);
}

TEST_P(GatherTest, OneIndexRepeated) {
  expect_squares(engine_, Indices(30000, 11111), 20000);
}

TEST_P(GatherTest, AbsentIndices) {
  Indices indices = random_indices(30000, 40000);
  indices[0] = 20000;
  indices[1] = 19999;
  indices[2] = ~0U;
  expect_squares(engine_, indices, 20000);
}

TEST_P(GatherTest, NothingAsked) {
  expect_squares(engine_, {}, 20000);
}

TEST_P(GatherTest, EmptyTable) {
  expect_squares(engine_, random_indices(100, 5), 0);
}

TEST_P(GatherTest, TableOfJustAboutASlice) {
  for (const std::uint64_t size : {4095, 4096, 4097}) {
    expect_squares(engine_, random_indices(9000, 5000), size);
  }
}

TEST(GatherBudgetTest, TooLittleMemoryIsRefused) {
  TestEngine engine({.budget_bytes = kLeast - 1});
  EXPECT_THROW(expect_squares(engine, {0}, 1), Error);
}

TEST(GatherBudgetTest, AHotIndexCostsNothingExtra) {
  TestEngine spread({.budget_bytes = kLeast}), hot({.budget_bytes = kLeast});
  expect_squares(spread, random_indices(30000, 20000), 20000);
  expect_squares(hot, Indices(30000, 5), 20000);
  EXPECT_LE(hot.scratch.written_bytes(), spread.scratch.written_bytes());
}

}  // namespace
}  // namespace atlasgauge
