#include "stream/engine/row_visit.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <mutex>
#include <numeric>
#include <set>
#include <span>
#include <vector>

#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

TEST(RowVisitTest, EveryRowComesOnceWithItsRecordsSideBySide) {
  for (const std::size_t workers : {1, 3}) {
    TestEngine engine({.block_bytes = 8192, .workers = workers});
    std::vector<std::uint32_t> numbers(10000);
    std::iota(numbers.begin(), numbers.end(), 0);
    std::vector<double> halves;
    for (const std::uint32_t number : numbers) halves.push_back(number / 2.0);
    const Spill<std::uint32_t> first = spill_of(engine, numbers);
    const Spill<double> second = spill_of(engine, halves);
    std::mutex mutex;
    std::set<std::uint64_t> seen;
    const auto use = [&](std::size_t, std::uint64_t first_row, auto some, auto others) {
      ASSERT_EQ(some.size(), others.size());
      const std::lock_guard lock(mutex);
      for (std::size_t i = 0; i < some.size(); ++i) {
        EXPECT_EQ(some[i], first_row + i);
        EXPECT_EQ(others[i], some[i] / 2.0);
        EXPECT_TRUE(seen.insert(first_row + i).second);
      }
    };
    visit_rows(engine, use, first, second);
    EXPECT_EQ(seen.size(), 10000U);
  }
}

TEST(RowVisitTest, NoRowsAreNoCalls) {
  TestEngine engine;
  const Spill<double> none = spill_of(engine, std::vector<double>());
  visit_rows(
      engine, [](std::size_t, std::uint64_t, auto) { FAIL(); }, none);
}

TEST(RowVisitTest, AllWorkersTakePart) {
  TestEngine engine({.workers = 2});
  const Spill<std::uint32_t> many = spill_of(engine, std::vector<std::uint32_t>(100000));
  visit_rows(
      engine, [](std::size_t, std::uint64_t, auto) {}, many);
  EXPECT_GT(engine.workers.items_done(0) + engine.workers.items_done(1), 90U);
}

}  // namespace
}  // namespace atlasgauge
