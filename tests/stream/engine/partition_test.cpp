#include "stream/engine/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

std::vector<std::uint32_t> sorted_records(Spill<std::uint32_t>& spill) {
  std::vector<std::uint32_t> records = records_of(spill);
  std::sort(records.begin(), records.end());
  return records;
}

TEST(PartitionTest, EveryRecordComesToItsBucket) {
  for (const std::uint64_t resident : {0, 2 * 4096, 1 << 20}) {
    TestEngine engine({.resident_bytes = resident});
    Partition<std::uint32_t> partition(engine.scratch, 3);
    Partition<std::uint32_t>::Writer writer(partition);
    for (std::uint32_t i = 0; i < 9000; ++i) writer.push(i % 3, i);
    writer.flush();
    std::vector<Spill<std::uint32_t>> buckets = partition.finish();
    ASSERT_EQ(buckets.size(), 3U);
    for (std::uint32_t bucket = 0; bucket < 3; ++bucket) {
      const std::vector<std::uint32_t> records = sorted_records(buckets[bucket]);
      ASSERT_EQ(records.size(), 3000U);
      for (std::uint32_t i = 0; i < 3000; ++i) ASSERT_EQ(records[i], 3 * i + bucket);
    }
  }
}

TEST(PartitionTest, OneWriterKeepsTheOrderInABucket) {
  TestEngine engine;
  Partition<std::uint32_t> partition(engine.scratch, 2);
  Partition<std::uint32_t>::Writer writer(partition);
  for (std::uint32_t i = 0; i < 5000; ++i) writer.push(i * 7 % 5 == 0, i);
  writer.flush();
  for (Spill<std::uint32_t>& bucket : partition.finish()) {
    const std::vector<std::uint32_t> records = records_of(bucket);
    EXPECT_TRUE(std::is_sorted(records.begin(), records.end()));
  }
}

TEST(PartitionTest, WritersOfManyThreadsLoseNothing) {
  TestEngine engine({.workers = 3});
  Partition<std::uint32_t> partition(engine.scratch, 5);
  std::vector<Partition<std::uint32_t>::Writer> writers;
  for (int i = 0; i < 3; ++i) writers.emplace_back(partition);
  engine.workers.for_each(30, [&](std::size_t worker, std::size_t item) {
    for (std::uint32_t i = 0; i < 1000; ++i) {
      const auto record = static_cast<std::uint32_t>(item * 1000 + i);
      writers[worker].push(record % 5, record);
    }
  });
  for (auto& writer : writers) writer.flush();
  std::vector<Spill<std::uint32_t>> buckets = partition.finish();
  for (std::uint32_t bucket = 0; bucket < 5; ++bucket) {
    const std::vector<std::uint32_t> records = sorted_records(buckets[bucket]);
    ASSERT_EQ(records.size(), 6000U);
    for (std::uint32_t i = 0; i < 6000; ++i) ASSERT_EQ(records[i], 5 * i + bucket);
  }
}

TEST(PartitionTest, EmptyBucketsAreEmptySpills) {
  TestEngine engine;
  Partition<std::uint32_t> partition(engine.scratch, 4);
  for (Spill<std::uint32_t>& bucket : partition.finish()) EXPECT_TRUE(bucket.empty());
}

TEST(PartitionTest, MemoryIsABlockABucketAndTheStaging) {
  using Numbers = Partition<std::uint32_t>;
  EXPECT_EQ(Numbers::memory_bytes(3, 2, 4096), 3 * (4096U + 2 * 1024));
  EXPECT_EQ(Numbers::memory_bytes(3, 2, 1 << 20), 3 * ((1U << 20) + 2 * 4096));
}

TEST(SharedSpillTest, GathersWhatAllThreadsPush) {
  TestEngine engine({.workers = 3});
  SharedSpill<std::uint32_t> shared(engine.scratch);
  std::vector<SharedSpill<std::uint32_t>::Writer> writers;
  for (int i = 0; i < 3; ++i) writers.emplace_back(shared);
  engine.workers.for_each(10000, [&](std::size_t worker, std::size_t item) {
    writers[worker].push(static_cast<std::uint32_t>(item));
  });
  for (auto& writer : writers) writer.flush();
  Spill<std::uint32_t> spill = shared.finish();
  std::vector<std::uint32_t> expected(10000);
  std::iota(expected.begin(), expected.end(), 0U);
  EXPECT_EQ(sorted_records(spill), expected);
}

}  // namespace
}  // namespace atlasgauge
