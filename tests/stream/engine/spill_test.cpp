#include "stream/engine/spill.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

/// 170 of these fill a block of 4096 bytes, and leave 16 bytes over.
struct Pebble {
  std::uint64_t number, a, b;
};
constexpr std::uint64_t kPerBlock = 170;

constexpr std::uint64_t kSizes[] = {0, 1, 169, 170, 171, 339, 340, 341, 1000};

std::vector<Pebble> pebbles(std::uint64_t count) {
  std::vector<Pebble> list;
  for (std::uint64_t i = 0; i < count; ++i) list.push_back({i, i * i, ~i});
  return list;
}

void expect_pebbles(const std::vector<Pebble>& list, std::uint64_t count) {
  ASSERT_EQ(list.size(), count);
  for (std::uint64_t i = 0; i < count; ++i) {
    ASSERT_EQ(list[i].number, i);
    ASSERT_EQ(list[i].b, ~i);
  }
}

/// All records, over next_block().
std::vector<Pebble> by_blocks(SpillReader<Pebble> reader) {
  std::vector<Pebble> list;
  for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
    list.insert(list.end(), block.begin(), block.end());
  }
  return list;
}

/// The pool holds none, some or all of the blocks.
class SpillTest : public testing::TestWithParam<std::uint64_t> {
 protected:
  TestEngine engine_{{.resident_bytes = GetParam() * 4096}};
};
INSTANTIATE_TEST_SUITE_P(ResidentBlocks, SpillTest, testing::Values(0, 1, 100));

TEST_P(SpillTest, GivesBackWhatWasPushed) {
  for (const std::uint64_t count : kSizes) {
    SpillWriter<Pebble> writer(engine_.scratch);
    for (const Pebble& pebble : pebbles(count)) writer.push(pebble);
    EXPECT_EQ(writer.size(), count);
    Spill<Pebble> spill = writer.finish();
    EXPECT_EQ(spill.size(), count);
    EXPECT_EQ(spill.block_count(), (count + kPerBlock - 1) / kPerBlock);
    expect_pebbles(records_of(spill), count);
  }
}

TEST_P(SpillTest, GivesBackWhatWasAppendedInPieces) {
  for (const std::size_t piece : {1U, 7U, 169U, 170U, 171U, 400U}) {
    const std::vector<Pebble> all = pebbles(1000);
    SpillWriter<Pebble> writer(engine_.scratch);
    for (std::size_t begin = 0; begin < all.size(); begin += piece) {
      writer.append({&all[begin], std::min(piece, all.size() - begin)});
    }
    expect_pebbles(records_of(writer.finish()), 1000);
  }
}

TEST_P(SpillTest, KeepingReaderCanBeRepeated) {
  for (const std::uint64_t count : kSizes) {
    Spill<Pebble> spill = spill_of(engine_, pebbles(count));
    for (int i = 0; i < 2; ++i) expect_pebbles(by_blocks(SpillReader<Pebble>(spill)), count);
  }
}

TEST_P(SpillTest, ConsumingReaderFreesAllBlocks) {
  for (const std::uint64_t count : kSizes) {
    Spill<Pebble> spill = spill_of(engine_, pebbles(count));
    const std::uint64_t peak = engine_.scratch.peak_bytes();
    expect_pebbles(by_blocks(SpillReader<Pebble>(spill, SpillReader<Pebble>::Mode::kConsume)),
                   count);
    Spill<Pebble> next = spill_of(engine_, pebbles(count));
    EXPECT_EQ(engine_.scratch.peak_bytes(), peak) << "the blocks were not free for the next";
  }
}

TEST_P(SpillTest, ConsumingHalfWayFreesEveryBlockOnce) {
  {
    Spill<Pebble> spill = spill_of(engine_, pebbles(1000));
    SpillReader<Pebble> reader(spill, SpillReader<Pebble>::Mode::kConsume);
    std::vector<Pebble> some(400);
    reader.read(some);
  }
  const Spill<Pebble> a = spill_of(engine_, pebbles(1000));
  EXPECT_EQ(engine_.scratch.peak_bytes(), 6 * 4096U);
}

TEST_P(SpillTest, CopyingWhileConsumingNeedsOneBlockMore) {
  Spill<Pebble> spill = spill_of(engine_, pebbles(1000));
  SpillReader<Pebble> reader(spill, SpillReader<Pebble>::Mode::kConsume);
  SpillWriter<Pebble> writer(engine_.scratch);
  for (Pebble pebble{}; reader.read(pebble);) writer.push(pebble);
  expect_pebbles(records_of(writer.finish()), 1000);
  EXPECT_EQ(engine_.scratch.peak_bytes(), 7 * 4096U);
}

TEST_P(SpillTest, ReadFillsAsFarAsRecordsLast) {
  Spill<Pebble> spill = spill_of(engine_, pebbles(500));
  SpillReader<Pebble> reader(spill);
  std::vector<Pebble> to(300);
  EXPECT_EQ(reader.read(to), 300U);
  EXPECT_EQ(to[299].number, 299U);
  EXPECT_EQ(reader.read(to), 200U);
  EXPECT_EQ(to[199].number, 499U);
  EXPECT_EQ(reader.read(to), 0U);
}

TEST_P(SpillTest, ReaderCanStartAnywhere) {
  const Spill<Pebble> spill = spill_of(engine_, pebbles(400));
  for (const std::uint64_t first : {0, 1, 169, 170, 171, 339, 340, 399, 400}) {
    SpillReader<Pebble> reader(spill, first);
    Pebble pebble{};
    for (std::uint64_t i = first; i < 400; ++i) {
      ASSERT_TRUE(reader.read(pebble));
      ASSERT_EQ(pebble.number, i);
    }
    EXPECT_FALSE(reader.read(pebble));
  }
}

TEST_P(SpillTest, ReaderCanStartBehindFreedBlocks) {
  Spill<Pebble> spill = spill_of(engine_, pebbles(400));
  SpillReader<Pebble> first(spill, SpillReader<Pebble>::Mode::kConsume);
  std::vector<Pebble> some(200);
  first.read(some);
  Pebble pebble{};
  ASSERT_TRUE(SpillReader<Pebble>(spill, 200).read(pebble));
  EXPECT_EQ(pebble.number, 200U);
}

TEST_P(SpillTest, BlocksCanBeLoadedInAnyOrder) {
  const Spill<Pebble> spill = spill_of(engine_, pebbles(500));
  BlockBuffer buffer;
  EXPECT_EQ(spill.load(2, buffer)[0].number, 340U);
  EXPECT_EQ(spill.load(0, buffer)[169].number, 169U);
  EXPECT_EQ(spill.load(2, buffer).size(), 160U);
}

TEST_P(SpillTest, MovedReaderGoesOn) {
  Spill<Pebble> spill = spill_of(engine_, pebbles(500));
  SpillReader<Pebble> first(spill);
  Pebble pebble{};
  first.read(pebble);
  SpillReader<Pebble> second(std::move(first));
  second.read(pebble);
  EXPECT_EQ(pebble.number, 1U);
}

TEST_P(SpillTest, MovedSpillOwnsTheRecords) {
  Spill<Pebble> first = spill_of(engine_, pebbles(500));
  Spill<Pebble> second = spill_of(engine_, pebbles(3));
  second = std::move(first);
  EXPECT_TRUE(first.empty());
  expect_pebbles(records_of(second), 500);
}

TEST_P(SpillTest, ClearFreesAndEmpties) {
  Spill<Pebble> spill = spill_of(engine_, pebbles(500));
  const std::uint64_t peak = engine_.scratch.peak_bytes();
  spill.clear();
  EXPECT_TRUE(spill.empty());
  EXPECT_TRUE(records_of(spill).empty());
  const Spill<Pebble> next = spill_of(engine_, pebbles(500));
  EXPECT_EQ(engine_.scratch.peak_bytes(), peak);
}

TEST_P(SpillTest, WriterStartsOverAfterFinish) {
  SpillWriter<Pebble> writer(engine_.scratch);
  writer.append(pebbles(200));
  Spill<Pebble> first = writer.finish();
  writer.append(pebbles(3));
  Spill<Pebble> second = writer.finish();
  expect_pebbles(records_of(first), 200);
  expect_pebbles(records_of(second), 3);
  EXPECT_TRUE(writer.finish().empty());
}

TEST_P(SpillTest, AbandonedWriterFreesItsBlocks) {
  {
    SpillWriter<Pebble> writer(engine_.scratch);
    writer.append(pebbles(200));
  }
  const Spill<Pebble> next = spill_of(engine_, pebbles(200));
  EXPECT_EQ(engine_.scratch.peak_bytes(), 2 * 4096U);
}

TEST_P(SpillTest, MovedWriterGoesOnAndFreesItsBlockOnce) {
  SpillWriter<Pebble> first(engine_.scratch);
  first.append(pebbles(200));
  SpillWriter<Pebble> second(std::move(first));
  { const SpillWriter<Pebble> dies(std::move(first)); }
  Spill<Pebble> spill = second.finish();
  Spill<Pebble> next = spill_of(engine_, std::vector<Pebble>(100));
  expect_pebbles(records_of(spill), 200);
}

TEST(EmptySpillTest, DefaultSpillHasNothing) {
  Spill<int> spill;
  EXPECT_TRUE(spill.empty());
  EXPECT_TRUE(SpillReader<int>(spill).next_block().empty());
}

TEST(EmptySpillTest, NothingIsAllocatedForNothing) {
  TestEngine engine;
  Spill<int> spill = SpillWriter<int>(engine.scratch).finish();
  EXPECT_TRUE(spill.empty());
  EXPECT_EQ(engine.scratch.peak_bytes(), 0U);
}

}  // namespace
}  // namespace atlasgauge
