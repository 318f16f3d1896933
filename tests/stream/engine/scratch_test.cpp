#include "stream/engine/scratch.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kBlock = 8192;

class ScratchTest : public testing::Test {
 protected:
  Scratch::Options options(std::uint64_t resident_blocks) const {
    return {dir_.path().string(), kBlock, resident_blocks * kBlock};
  }
  std::size_t files_in_directory() const {
    const std::filesystem::directory_iterator all(dir_.path());
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }

  TempDir dir_;
  MemoryBudget budget_{1 << 20};
};

AlignedBytes filled(std::size_t bytes, int value) {
  AlignedBytes memory(bytes);
  std::memset(memory.data(), value, bytes);
  return memory;
}

void expect_round_trip(Scratch& scratch) {
  const auto a = scratch.allocate(), b = scratch.allocate();
  scratch.write(a, filled(kBlock, 1).data(), kBlock);
  scratch.write(b, filled(kBlock, 2).data(), 100);
  AlignedBytes back(kBlock);
  scratch.read(b, 0, back.data(), 100);
  EXPECT_EQ(static_cast<int>(back.data()[99]), 2);
  scratch.read(a, 4096, back.data(), 4096);
  EXPECT_EQ(static_cast<int>(back.data()[0]), 1);
}

TEST_F(ScratchTest, BlockSizeIsRoundedUpToTheAlignment) {
  Scratch scratch({dir_.path().string(), 5000, 0}, budget_);
  EXPECT_EQ(scratch.block_bytes(), 8192U);
}

TEST_F(ScratchTest, PoolIsReservedFromTheBudget) {
  {
    const Scratch scratch(options(3), budget_);
    EXPECT_EQ(budget_.free_bytes(), (1U << 20) - 3 * kBlock);
  }
  EXPECT_EQ(budget_.free_bytes(), 1U << 20);
}

TEST_F(ScratchTest, PoolLargerThanTheBudgetIsRefused) {
  MemoryBudget small(kBlock);
  EXPECT_THROW(Scratch(options(2), small), Error);
}

TEST_F(ScratchTest, ResidentBlocksAreHandedOutFirst) {
  Scratch scratch(options(2), budget_);
  const auto a = scratch.allocate(), b = scratch.allocate(), c = scratch.allocate();
  EXPECT_NE(scratch.resident(a), nullptr);
  EXPECT_NE(scratch.resident(b), nullptr);
  EXPECT_NE(scratch.resident(a), scratch.resident(b));
  EXPECT_EQ(scratch.resident(c), nullptr);
}

TEST_F(ScratchTest, FreedBlocksAreUsedAgainResidentOnesFirst) {
  Scratch scratch(options(1), budget_);
  const auto in_memory = scratch.allocate(), on_disk = scratch.allocate();
  scratch.free(on_disk);
  scratch.free(in_memory);
  EXPECT_EQ(scratch.allocate(), in_memory);
  EXPECT_EQ(scratch.allocate(), on_disk);
}

TEST_F(ScratchTest, LiveBlocksAreDistinct) {
  Scratch scratch(options(2), budget_);
  std::set<Scratch::BlockId> live;
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(live.insert(scratch.allocate()).second);
  scratch.free(*live.begin());
  scratch.free(*live.rbegin());
  live.erase(live.begin());
  live.erase(std::prev(live.end()));
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(live.insert(scratch.allocate()).second);
}

TEST_F(ScratchTest, WhatFitsInThePoolNeverTouchesTheDirectory) {
  Scratch scratch({"/no/such/directory", kBlock, 2 * kBlock}, budget_);
  for (int i = 0; i < 2; ++i) std::memset(scratch.resident(scratch.allocate()), 7, kBlock);
  EXPECT_EQ(scratch.written_bytes(), 0U);
  EXPECT_EQ(scratch.spilled_bytes(), 0U);
}

TEST_F(ScratchTest, MissingDirectoryIsAResourceErrorThatNamesIt) {
  Scratch scratch({"/no/such/directory", kBlock, 0}, budget_);
  try {
    scratch.allocate();
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    EXPECT_NE(std::string(error.what()).find("/no/such/directory"), std::string::npos);
    EXPECT_NE(std::string(error.what()).find("--tmp-dir"), std::string::npos);
  }
}

TEST_F(ScratchTest, BlocksOnDiskKeepTheirBytes) {
  Scratch scratch(options(0), budget_);
  expect_round_trip(scratch);
}

TEST_F(ScratchTest, FileHasNoName) {
  Scratch scratch(options(0), budget_);
  expect_round_trip(scratch);
  EXPECT_EQ(files_in_directory(), 0U);
}

TEST_F(ScratchTest, WorksWhereDirectInputOutputDoesNot) {
  if (!std::filesystem::is_directory("/dev/shm")) GTEST_SKIP() << "no /dev/shm here";
  Scratch scratch({"/dev/shm", kBlock, 0}, budget_);
  expect_round_trip(scratch);
}

TEST_F(ScratchTest, CountsWhatItWroteAndRead) {
  Scratch scratch(options(0), budget_);
  const auto block = scratch.allocate();
  const AlignedBytes memory = filled(kBlock, 1);
  scratch.write(block, memory.data(), 5000);
  scratch.read(block, 0, memory.data(), 10);
  EXPECT_EQ(scratch.written_bytes(), 8192U);
  EXPECT_EQ(scratch.read_bytes(), 4096U);
}

TEST_F(ScratchTest, PeakCountsBlocksAliveAtOnce) {
  Scratch scratch(options(1), budget_);
  const auto a = scratch.allocate(), b = scratch.allocate();
  scratch.free(a);
  scratch.free(b);
  scratch.free(scratch.allocate());
  EXPECT_EQ(scratch.peak_bytes(), 2 * kBlock);
  EXPECT_EQ(scratch.spilled_bytes(), kBlock);
}

TEST_F(ScratchTest, ReadPastWhatWasWrittenIsAResourceError) {
  Scratch scratch(options(0), budget_);
  const auto block = scratch.allocate();
  AlignedBytes memory(kBlock);
  EXPECT_THROW(scratch.read(block, 0, memory.data(), kBlock), Error);
}

TEST_F(ScratchTest, FailedWriteIsAResourceError) {
  Scratch scratch(options(0), budget_);
  const auto block = scratch.allocate();
  const AlignedBytes memory = filled(kBlock, 1);
  // Memory that cannot be read makes pwrite fail, as a full disk would.
  EXPECT_THROW(scratch.write(block, nullptr, kBlock), Error);
  EXPECT_NO_THROW(scratch.write(block, memory.data(), kBlock));
}

TEST_F(ScratchTest, BuffersAreLentAgain) {
  Scratch scratch(options(0), budget_);
  BlockBuffer first;
  const std::byte* memory = first.data(scratch);
  EXPECT_EQ(first.data(scratch), memory);
  first.release();
  BlockBuffer second;
  EXPECT_EQ(second.data(scratch), memory);
}

TEST_F(ScratchTest, MovedBufferIsGivenBackOnce) {
  Scratch scratch(options(0), budget_);
  BlockBuffer first;
  const std::byte* memory = first.data(scratch);
  BlockBuffer second(std::move(first));
  EXPECT_EQ(second.data(scratch), memory);
  EXPECT_NE(first.data(scratch), memory);
}

}  // namespace
}  // namespace atlasgauge
