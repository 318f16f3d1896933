#include "stream/engine/early_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <mutex>
#include <numeric>
#include <random>
#include <tuple>
#include <vector>

#include "io/error.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

struct Pebble {
  std::uint32_t colour, number;
  std::uint32_t key() const { return colour; }
};
using Pebbles = std::vector<Pebble>;
using Numbers = std::vector<std::uint32_t>;

struct Limits {
  std::uint64_t memory_bytes = 1 << 20;
  std::size_t largest_group = ~std::size_t{0};
};

/// Every pebble is an item of its own, and its number that of the item.
class Grouping {
 public:
  Grouping(TestEngine& engine, const Pebbles& pebbles, const Limits& limits)
      : engine_(engine), pebbles_(pebbles) {
    std::uint32_t key_end = 0;
    LastUses last_uses(engine.budget);
    for (std::uint32_t i = 0; i < pebbles.size(); ++i) {
      last_uses.note(pebbles[i].colour, i + 1);
      key_end = std::max(key_end, pebbles[i].colour + 1);
    }
    make({pebbles.size(), key_end, limits.memory_bytes, "a test"}, last_uses, limits.largest_group);
  }

  void add(std::size_t worker, std::size_t first, std::size_t end) {
    groups->add(worker, std::span(pebbles_).subspan(first, end - first));
  }

  /// In batches of a few, on all workers, to the end.
  void run() {
    struct Batch {
      std::size_t first = 0, end = 0;
    };
    std::vector<Batch> batches(engine_.workers.count());
    std::size_t next = 0;
    Workers::Pipeline pipeline;
    pipeline.produce = [&](std::size_t worker) {
      batches[worker] = {next, std::min(pebbles_.size(), next + 50)};
      next = batches[worker].end;
      return batches[worker].first < next;
    };
    pipeline.transform = [&](std::size_t worker) {
      add(worker, batches[worker].first, batches[worker].end);
      groups->group_passed(worker);
    };
    pipeline.commit = [&](std::size_t worker) { groups->pass(batches[worker].end); };
    engine_.workers.run(pipeline);
    early = by_key.size();
    groups->settle();
    settled = by_key.size();
    groups->process();
  }

  std::map<std::uint32_t, Numbers> by_key;
  std::size_t hot_keys = 0;
  std::size_t early = 0;    ///< groups before the end
  std::size_t settled = 0;  ///< groups that were never spilled
  std::unique_ptr<EarlyGroups<Pebble>> groups;

 private:
  void make(const EarlyGroups<Pebble>::Plan& plan, const LastUses& last_uses,
            std::size_t largest_group) {
    groups = std::make_unique<EarlyGroups<Pebble>>(
        engine_, plan, last_uses, [this](std::size_t, std::span<Pebble> all) { keep(all); },
        [this](std::uint32_t, Spill<Pebble> all) {
          ++hot_keys;
          keep(records_of(all));
        },
        largest_group);
  }

  void keep(std::span<const Pebble> all) {
    Numbers numbers;
    for (const Pebble& pebble : all) {
      EXPECT_EQ(pebble.colour, all[0].colour);
      numbers.push_back(pebble.number);
    }
    std::sort(numbers.begin(), numbers.end());
    const std::lock_guard lock(mutex_);
    EXPECT_TRUE(by_key.emplace(all[0].colour, numbers).second) << "key " << all[0].colour;
  }

  TestEngine& engine_;
  Pebbles pebbles_;
  std::mutex mutex_;
};

std::map<std::uint32_t, Numbers> expected_groups(const Pebbles& pebbles) {
  std::map<std::uint32_t, Numbers> groups;
  for (const Pebble& pebble : pebbles) groups[pebble.colour].push_back(pebble.number);
  return groups;
}

/// Six of each colour, in the order of colours but for some scatter.
Pebbles in_order(std::uint32_t colours) {
  std::mt19937 random(1);
  Pebbles pebbles;
  for (std::uint32_t i = 0; i < 6 * colours; ++i) {
    pebbles.push_back(
        {std::min(colours - 1, i / 6 + static_cast<std::uint32_t>(random() % 50)), i});
  }
  return pebbles;
}

Pebbles shuffled(std::uint32_t colours) {
  Pebbles pebbles = in_order(colours);
  std::shuffle(pebbles.begin(), pebbles.end(), std::mt19937(2));
  for (std::uint32_t i = 0; i < pebbles.size(); ++i) pebbles[i].number = i;
  return pebbles;
}

TEST(EarlyGroupsTest, RangeIsGroupedWhenItsLastItemHasPassed) {
  TestEngine engine({.workers = 1});
  Pebbles pebbles;
  for (std::uint32_t i = 0; i < 100'000; ++i) pebbles.push_back({i / 4, i});
  Grouping grouping(engine, pebbles, {});
  grouping.add(0, 0, 50'000);
  grouping.groups->group_passed(0);
  EXPECT_TRUE(grouping.by_key.empty()) << "nothing has passed";
  grouping.groups->pass(50'000);
  grouping.groups->group_passed(0);
  EXPECT_LE(grouping.by_key.size(), 12'500U);
  EXPECT_GT(grouping.by_key.size(), 10'000U);
  EXPECT_EQ(grouping.by_key[100], (Numbers{400, 401, 402, 403}));
}

TEST(EarlyGroupsTest, RangeWaitsForARecordThatComesMuchLater) {
  TestEngine engine({.workers = 1});
  Pebbles pebbles;
  for (std::uint32_t i = 0; i < 100'000; ++i) pebbles.push_back({i / 4, i});
  pebbles.push_back({100, 100'000});
  Grouping grouping(engine, pebbles, {});
  grouping.add(0, 0, 100'000);
  grouping.groups->pass(100'000);
  grouping.groups->group_passed(0);
  EXPECT_GT(grouping.by_key.size(), 20'000U);
  EXPECT_FALSE(grouping.by_key.contains(100));
  grouping.add(0, 100'000, 100'001);
  grouping.groups->pass(100'001);
  grouping.groups->group_passed(0);
  EXPECT_EQ(grouping.by_key[100], (Numbers{400, 401, 402, 403, 100'000}));
}

TEST(EarlyGroupsTest, RecordsOfAllWorkersAreInTheGroup) {
  TestEngine engine({.workers = 3});
  Pebbles pebbles;
  for (std::uint32_t i = 0; i < 60; ++i) pebbles.push_back({i / 6, i});
  Grouping grouping(engine, pebbles, {});
  for (std::size_t i = 0; i < 60; ++i) grouping.add(i % 3, i, i + 1);
  grouping.groups->pass(60);
  grouping.groups->group_passed(1);
  EXPECT_EQ(grouping.by_key, expected_groups(pebbles));
}

TEST(EarlyGroupsTest, RecordAfterTheLastOfItsKeyIsAFault) {
  TestEngine engine({.workers = 1});
  const Pebbles pebbles{{0, 0}, {0, 1}};
  Grouping grouping(engine, pebbles, {});
  grouping.add(0, 0, 1);
  grouping.groups->pass(2);
  grouping.groups->group_passed(0);
  EXPECT_THROW(grouping.add(0, 1, 2), Error);
}

TEST(EarlyGroupsTest, InOrderNothingIsSpilled) {
  TestEngine engine({.budget_bytes = 4 << 20, .workers = 2});
  const Pebbles pebbles = in_order(100'000);
  Grouping grouping(engine, pebbles, {.memory_bytes = 1 << 20});
  grouping.run();
  EXPECT_EQ(grouping.by_key, expected_groups(pebbles));
  EXPECT_GT(grouping.early, 90'000U);
  EXPECT_EQ(grouping.settled, grouping.by_key.size());
  EXPECT_EQ(engine.scratch.peak_bytes(), 0U);
}

TEST(EarlyGroupsTest, ShuffledAllAreSpilledAndGroupedInTheEnd) {
  TestEngine engine({.budget_bytes = 4 << 20, .workers = 2});
  const Pebbles pebbles = shuffled(100'000);
  Grouping grouping(engine, pebbles, {.memory_bytes = 1 << 20});
  grouping.run();
  EXPECT_EQ(grouping.by_key, expected_groups(pebbles));
  EXPECT_EQ(grouping.early, 0U);
  EXPECT_GT(engine.scratch.peak_bytes(), pebbles.size() * sizeof(Pebble) / 2);
}

TEST(EarlyGroupsTest, ShuffledInEnoughMemoryNothingIsSpilled) {
  TestEngine engine({.workers = 2});
  const Pebbles pebbles = shuffled(100'000);
  Grouping grouping(engine, pebbles, {.memory_bytes = 16 << 20});
  grouping.run();
  EXPECT_EQ(grouping.by_key, expected_groups(pebbles));
  EXPECT_EQ(engine.scratch.peak_bytes(), 0U);
}

TEST(EarlyGroupsTest, OrderThatIsNotKnownIsNone) {
  TestEngine engine({.workers = 2});
  const Pebbles pebbles = in_order(1000);
  std::map<std::uint32_t, std::size_t> sizes;
  EarlyGroups<Pebble> groups(
      engine, {pebbles.size(), 1000, 1 << 20, "a test"}, LastUses(),
      [&](std::size_t, std::span<Pebble> all) { sizes[all[0].colour] += all.size(); },
      [](std::uint32_t, const Spill<Pebble>&) {});
  groups.add(0, pebbles);
  groups.pass(pebbles.size());
  groups.group_passed(0);
  EXPECT_TRUE(sizes.empty());
}

TEST(EarlyGroupsTest, FarBucketIsSpilledForNearOnes) {
  TestEngine engine({.budget_bytes = 4 << 20, .workers = 2});
  // Every second pebble stays open until the end, and the others come in order.
  Pebbles pebbles;
  for (std::uint32_t i = 0; i < 200'000; ++i) {
    pebbles.push_back({i % 2 == 0 ? 50'000 + i * 7919 % 50'000 : i / 4, i});
  }
  Grouping grouping(engine, pebbles, {.memory_bytes = 1 << 20});
  grouping.run();
  EXPECT_EQ(grouping.by_key, expected_groups(pebbles));
  EXPECT_GT(grouping.early, 30'000U);
  EXPECT_LT(grouping.settled, grouping.by_key.size());
}

TEST(EarlyGroupsTest, GroupsAboveTheLargestAreHandedOverAsSpills) {
  TestEngine engine({.workers = 2});
  Pebbles pebbles;
  for (std::uint32_t i = 0; i < 5000; ++i) pebbles.push_back({i < 4000 ? i / 2 : 2000, i});
  Grouping grouping(engine, pebbles, {.largest_group = 2});
  grouping.run();
  EXPECT_EQ(grouping.by_key, expected_groups(pebbles));
  EXPECT_EQ(grouping.hot_keys, 1U);
}

TEST(EarlyGroupsTest, HotKeyAmongNearOnes) {
  TestEngine engine({.budget_bytes = 1 << 20, .workers = 2});
  Pebbles pebbles;
  for (std::uint32_t i = 0; i < 300'000; ++i) {
    pebbles.push_back({i % 3 == 0 ? 60'000 : i / 5, i});
  }
  Grouping grouping(engine, pebbles, {.memory_bytes = 256 << 10});
  grouping.run();
  EXPECT_EQ(grouping.by_key, expected_groups(pebbles));
  EXPECT_EQ(grouping.hot_keys, 1U);
  EXPECT_GT(grouping.early, 10'000U);
}

/// Of memory and workers, down to the least that works.
class EarlyGroupsAnyMemoryTest
    : public testing::TestWithParam<std::tuple<std::uint64_t, std::size_t>> {
 protected:
  void expect_all(const Pebbles& pebbles) {
    const auto [memory_kib, workers] = GetParam();
    TestEngine engine(
        {.budget_bytes = (64 << 10) * workers + (memory_kib << 10), .workers = workers});
    Grouping grouping(engine, pebbles, {.memory_bytes = memory_kib << 10});
    grouping.run();
    EXPECT_EQ(grouping.by_key, expected_groups(pebbles));
    EXPECT_EQ(engine.budget.free_bytes(), engine.budget.limit_bytes());
  }
};
INSTANTIATE_TEST_SUITE_P(MemoryAndWorkers, EarlyGroupsAnyMemoryTest,
                         testing::Combine(testing::Values(10, 40, 200, 4096),
                                          testing::Values(1, 2, 5)));

TEST_P(EarlyGroupsAnyMemoryTest, InOrder) {
  expect_all(in_order(5000));
}

TEST_P(EarlyGroupsAnyMemoryTest, Shuffled) {
  expect_all(shuffled(5000));
}

TEST_P(EarlyGroupsAnyMemoryTest, FirstHalfInOrder) {
  Pebbles pebbles = in_order(5000);
  std::shuffle(pebbles.begin() + static_cast<std::ptrdiff_t>(pebbles.size() / 2), pebbles.end(),
               std::mt19937(3));
  for (std::uint32_t i = 0; i < pebbles.size(); ++i) pebbles[i].number = i;
  expect_all(pebbles);
}

TEST_P(EarlyGroupsAnyMemoryTest, OneKey) {
  Pebbles pebbles;
  for (std::uint32_t i = 0; i < 20'000; ++i) pebbles.push_back({0, i});
  expect_all(pebbles);
}

TEST_P(EarlyGroupsAnyMemoryTest, FewRecordsOfManyKeys) {
  Pebbles pebbles;
  for (std::uint32_t i = 0; i < 2000; ++i) pebbles.push_back({i * 400'000, i});
  expect_all(pebbles);
}

TEST_P(EarlyGroupsAnyMemoryTest, Nothing) {
  expect_all({});
}

}  // namespace
}  // namespace atlasgauge
