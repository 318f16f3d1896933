#include "stream/engine/block_memory.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <utility>
#include <vector>

namespace atlasgauge {
namespace {

constexpr std::size_t kMiB = 1 << 20;

std::vector<BlockBytes> lend(BlockMemory& memory, std::size_t count) {
  std::vector<BlockBytes> blocks;
  for (std::size_t i = 0; i < count; ++i) blocks.push_back(memory.lend());
  return blocks;
}

TEST(BlockMemoryTest, BlocksDoNotOverlap) {
  for (const std::size_t block : {std::size_t{4096}, kMiB / 4, 3 * kMiB}) {
    BlockMemory memory(block);
    std::vector<BlockBytes> blocks = lend(memory, 20);
    for (std::size_t i = 0; i < 20; ++i) std::memset(blocks[i].data(), static_cast<int>(i), block);
    for (std::size_t i = 0; i < 20; ++i) {
      EXPECT_EQ(static_cast<std::size_t>(blocks[i].data()[0]), i);
      EXPECT_EQ(static_cast<std::size_t>(blocks[i].data()[block - 1]), i);
    }
  }
}

TEST(BlockMemoryTest, BlocksOfAQuarterMebibyteShareAHugePage) {
  BlockMemory memory(kMiB / 4);
  const std::vector<BlockBytes> blocks = lend(memory, 9);
  EXPECT_EQ(memory.held_bytes(), 4 * kMiB);
}

TEST(BlockMemoryTest, AReturnedBlockIsLentAgain) {
  BlockMemory memory(4096);
  BlockBytes block = memory.lend();
  const std::byte* const place = block.data();
  block.release();
  EXPECT_EQ(memory.lend().data(), place);
}

TEST(BlockMemoryTest, MovedBlockIsGivenBackOnce) {
  BlockMemory memory(4096);
  BlockBytes first = memory.lend();
  const std::byte* const place = first.data();
  const BlockBytes second(std::move(first));
  EXPECT_EQ(second.data(), place);
  EXPECT_NE(memory.lend().data(), place);
}

TEST(BlockMemoryTest, EmptySlabsGoBackButForAFew) {
  for (const std::size_t block : {std::size_t{4096}, kMiB / 4, 3 * kMiB}) {
    BlockMemory memory(block);
    lend(memory, 100).clear();
    EXPECT_LE(memory.held_bytes(), 8 * block);
    EXPECT_GE(memory.held_bytes(), block);
  }
}

TEST(BlockMemoryTest, LoansComeFromTheFirstSlabSoThatTheOthersEmpty) {
  BlockMemory memory(kMiB);
  std::vector<BlockBytes> blocks = lend(memory, 40);
  blocks.erase(blocks.begin(), blocks.begin() + 10);
  const std::vector<BlockBytes> more = lend(memory, 10);
  EXPECT_EQ(memory.held_bytes(), 40 * kMiB);
}

}  // namespace
}  // namespace atlasgauge
