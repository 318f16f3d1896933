#include "stream/engine/keyed_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <random>
#include <vector>

#include "io/error.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

struct Pebble {
  std::uint32_t colour, number;
  std::uint32_t key() const { return colour; }
};

using Numbers = std::vector<std::uint32_t>;

/// What came out, by key.
struct Groups {
  std::map<std::uint32_t, Numbers> by_key;
  std::size_t hot_keys = 0;
  bool repeated = false;

  void add(std::uint32_t key, Numbers numbers) {
    std::sort(numbers.begin(), numbers.end());
    repeated = !by_key.emplace(key, std::move(numbers)).second || repeated;
  }
};

Groups group(TestEngine& engine, const std::vector<Pebble>& pebbles, std::uint32_t key_end,
             std::size_t largest_group = ~std::size_t{0}) {
  const std::uint64_t free_bytes = engine.budget.free_bytes();
  const KeyRanges ranges =
      KeyedGroups<Pebble>::plan(engine, pebbles.size(), 0, key_end, free_bytes, free_bytes / 2);
  std::vector<Spill<Pebble>> buckets;
  {
    Partition<Pebble> partition(engine.scratch, ranges.bucket_count());
    Partition<Pebble>::Writer writer(partition);
    for (const Pebble& pebble : pebbles) writer.push(ranges.bucket_of(pebble.colour), pebble);
    writer.flush();
    buckets = partition.finish();
  }
  Groups groups;
  std::mutex mutex;
  KeyedGroups<Pebble> keyed(
      engine,
      [&](std::size_t worker, std::span<Pebble> all) {
        const std::lock_guard lock(mutex);
        EXPECT_LT(worker, engine.workers.count());
        Numbers numbers;
        for (const Pebble& pebble : all) {
          EXPECT_EQ(pebble.colour, all[0].colour);
          numbers.push_back(pebble.number);
        }
        groups.add(all[0].colour, numbers);
      },
      [&](std::uint32_t key, Spill<Pebble> all) {
        ++groups.hot_keys;
        Numbers numbers;
        for (const Pebble& pebble : records_of(all)) {
          EXPECT_EQ(pebble.colour, key);
          numbers.push_back(pebble.number);
        }
        groups.add(key, numbers);
      },
      largest_group);
  keyed.process({ranges, std::move(buckets)});
  return groups;
}

std::map<std::uint32_t, Numbers> expected_groups(const std::vector<Pebble>& pebbles) {
  std::map<std::uint32_t, Numbers> groups;
  for (const Pebble& pebble : pebbles) groups[pebble.colour].push_back(pebble.number);
  return groups;
}

std::vector<Pebble> pebbles_of(std::uint32_t count,
                               const std::function<std::uint32_t(std::uint32_t)>& colour) {
  std::vector<Pebble> pebbles;
  for (std::uint32_t i = 0; i < count; ++i) pebbles.push_back({colour(i), i});
  return pebbles;
}

/// Budgets from all in memory to the smallest that works.
class KeyedGroupsTest : public testing::TestWithParam<std::tuple<std::uint64_t, std::size_t>> {
 protected:
  Groups grouped(const std::vector<Pebble>& pebbles, std::uint32_t key_end) {
    const auto [kib, workers] = GetParam();
    TestEngine engine({.budget_bytes = (kib << 10) * workers, .workers = workers});
    Groups groups = group(engine, pebbles, key_end);
    EXPECT_FALSE(groups.repeated);
    EXPECT_EQ(groups.by_key, expected_groups(pebbles));
    EXPECT_EQ(engine.budget.free_bytes(), engine.budget.limit_bytes());
    return groups;
  }
};
INSTANTIATE_TEST_SUITE_P(BudgetsAndWorkers, KeyedGroupsTest,
                         testing::Combine(testing::Values(8, 12, 40, 4096),
                                          testing::Values(1, 2, 3)));

TEST_P(KeyedGroupsTest, GroupsAboveTheLargestAreHandedOverAsSpills) {
  const auto [kib, workers] = GetParam();
  TestEngine engine({.budget_bytes = (kib << 10) * workers, .workers = workers});
  const auto pebbles =
      pebbles_of(400, [](std::uint32_t i) { return i < 300 ? i / 3 : 100 + i / 50; });
  const Groups groups = group(engine, pebbles, 200, 3);
  EXPECT_EQ(groups.by_key, expected_groups(pebbles));
  EXPECT_EQ(groups.hot_keys, 2U);
}

TEST_P(KeyedGroupsTest, NothingHasNoGroups) {
  EXPECT_TRUE(grouped({}, 10).by_key.empty());
}

TEST_P(KeyedGroupsTest, OnlyKey) {
  grouped(pebbles_of(5, [](std::uint32_t) { return 0; }), 1);
}

TEST_P(KeyedGroupsTest, EveryKeyOnce) {
  grouped(pebbles_of(20000, [](std::uint32_t i) { return i; }), 20000);
}

TEST_P(KeyedGroupsTest, SixOfAKeyScattered) {
  grouped(pebbles_of(30000, [](std::uint32_t i) { return i * 7919 % 5000; }), 5000);
}

TEST_P(KeyedGroupsTest, SparseKeys) {
  grouped(pebbles_of(2000, [](std::uint32_t i) { return i * 400000; }), 1U << 30);
}

TEST_P(KeyedGroupsTest, AllInOneEndOfTheKeys) {
  grouped(pebbles_of(20000, [](std::uint32_t i) { return i % 50; }), 1U << 30);
  grouped(pebbles_of(20000, [](std::uint32_t i) { return (1U << 30) - 1 - i % 50; }), 1U << 30);
}

TEST_P(KeyedGroupsTest, KeysOfGeometricSizes) {
  std::mt19937 random(1);
  std::geometric_distribution<std::uint32_t> colour(0.3);
  grouped(pebbles_of(30000, [&](std::uint32_t) { return std::min(colour(random), 99U); }), 100);
}

TEST_P(KeyedGroupsTest, HotKeyAmongOthersComesAsASpill) {
  const Groups groups =
      grouped(pebbles_of(20000, [](std::uint32_t i) { return i % 2 == 0 ? 777 : i; }), 20000);
  const bool fits = std::get<0>(GetParam()) == 4096;
  EXPECT_EQ(groups.hot_keys, fits ? 0U : 1U);
}

TEST_P(KeyedGroupsTest, FirstAndLastKeyHot) {
  grouped(pebbles_of(20000, [](std::uint32_t i) { return i % 2 == 0 ? 0 : 999; }), 1000);
}

TEST(KeyedGroupsErrorTest, TooLittleMemoryIsRefused) {
  TestEngine engine({.budget_bytes = 2 * 4096 - 1, .workers = 1});
  EXPECT_THROW(group(engine, {{1, 1}}, 2), Error);
}

TEST(KeyedGroupsErrorTest, ErrorOfAGroupIsThrown) {
  TestEngine engine;
  std::vector<Spill<Pebble>> buckets;
  buckets.push_back(spill_of<Pebble>(engine, {{0, 0}, {1, 1}}));
  KeyedGroups<Pebble> keyed(
      engine, [](std::size_t, std::span<Pebble>) { throw std::runtime_error("bad group"); },
      [](std::uint32_t, Spill<Pebble>) {});
  EXPECT_THROW(keyed.process({{0, 2, 2}, std::move(buckets)}), std::runtime_error);
  EXPECT_EQ(engine.budget.free_bytes(), engine.budget.limit_bytes());
}

TEST(KeyedGroupsDistributeTest, EveryRecordComesToTheBucketOfItsKey) {
  for (const std::uint64_t kib : {64, 4096}) {
    TestEngine engine({.budget_bytes = kib << 10});
    const std::size_t engine_workers = engine.workers.count();
    auto buckets = KeyedGroups<Pebble>::distribute(engine, 9000, 1000, "pebbles", [&](auto push) {
      for (std::uint32_t i = 0; i < 9000; ++i) push(i % engine_workers, Pebble{i % 1000, i});
    });
    ASSERT_EQ(buckets.spills.size(), buckets.ranges.bucket_count());
    std::uint64_t records = 0;
    for (std::size_t i = 0; i < buckets.spills.size(); ++i) {
      for (const Pebble& pebble : records_of(buckets.spills[i])) {
        ASSERT_EQ(buckets.ranges.bucket_of(pebble.colour), i);
        ++records;
      }
    }
    EXPECT_EQ(records, 9000U);
    EXPECT_EQ(engine.budget.free_bytes(), engine.budget.limit_bytes());
  }
}

TEST(KeyRangesTest, BucketsCoverTheKeysWithoutOverlap) {
  const KeyRanges ranges{10, 31, 5};
  EXPECT_EQ(ranges.bucket_count(), 5U);
  EXPECT_EQ(ranges.bucket_of(10), 0U);
  EXPECT_EQ(ranges.bucket_of(14), 0U);
  EXPECT_EQ(ranges.bucket_of(15), 1U);
  EXPECT_EQ(ranges.bucket_of(30), 4U);
  EXPECT_EQ(ranges.keys_of(0), std::pair(10U, 15U));
  EXPECT_EQ(ranges.keys_of(4), std::pair(30U, 31U));
}

TEST(KeyRangesTest, NoKeysHaveOneBucket) {
  EXPECT_EQ((KeyRanges{0, 0, 1}).bucket_count(), 1U);
}

TEST(KeyRangesTest, PlanKeepsToTheDistributionMemory) {
  TestEngine engine({.workers = 1});
  const std::uint64_t cost = Partition<Pebble>::memory_bytes(1, 1, 4096);
  const KeyRanges ranges = KeyedGroups<Pebble>::plan(engine, 1 << 20, 0, 1000, 4096, 10 * cost);
  EXPECT_EQ(ranges.bucket_count(), 10U);
}

TEST(KeyRangesTest, PlanOfWhatFitsIsOneBucket) {
  TestEngine engine({.workers = 1});
  EXPECT_EQ(KeyedGroups<Pebble>::plan(engine, 100, 0, 100, 1 << 20, 1 << 20).bucket_count(), 1U);
}

}  // namespace
}  // namespace atlasgauge
