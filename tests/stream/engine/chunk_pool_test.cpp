#include "stream/engine/chunk_pool.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <set>
#include <thread>
#include <vector>

namespace atlasgauge {
namespace {

using Pool = ChunkPool<std::uint64_t>;

TEST(ChunkPoolTest, MemoryIsThatOfItsChunks) {
  EXPECT_EQ(Pool(10 * Pool::kChunkBytes).chunks(), 10U);
  EXPECT_EQ(Pool(Pool::kChunkBytes - 1).chunks(), 0U);
}

TEST(ChunkPoolTest, AnEmptyPoolGivesNone) {
  Pool pool(2 * Pool::kChunkBytes);
  EXPECT_NE(pool.take(Pool::kNoChunk), Pool::kNoChunk);
  EXPECT_NE(pool.take(Pool::kNoChunk), Pool::kNoChunk);
  EXPECT_EQ(pool.take(Pool::kNoChunk), Pool::kNoChunk);
  EXPECT_EQ(pool.free_chunks(), 0U);
}

TEST(ChunkPoolTest, ChunksOfAListFollowEachOther) {
  Pool pool(3 * Pool::kChunkBytes);
  const Pool::ChunkId last = pool.take(Pool::kNoChunk);
  const Pool::ChunkId first = pool.take(last);
  EXPECT_EQ(pool.next(first), last);
  EXPECT_EQ(pool.next(last), Pool::kNoChunk);
}

TEST(ChunkPoolTest, AListIsGivenBackWhole) {
  Pool pool(5 * Pool::kChunkBytes);
  Pool::ChunkId first = Pool::kNoChunk;
  for (int i = 0; i < 4; ++i) first = pool.take(first);
  EXPECT_EQ(pool.free_chunks(), 1U);
  pool.give_back(first);
  EXPECT_EQ(pool.free_chunks(), 5U);
  std::set<Pool::ChunkId> again;
  for (int i = 0; i < 5; ++i) again.insert(pool.take(Pool::kNoChunk));
  EXPECT_EQ(again.size(), 5U);
  EXPECT_EQ(again.count(Pool::kNoChunk), 0U);
}

TEST(ChunkPoolTest, NothingIsNoList) {
  Pool pool(Pool::kChunkBytes);
  pool.give_back(Pool::kNoChunk);
  EXPECT_EQ(pool.free_chunks(), 1U);
}

TEST(ChunkPoolTest, ThreadsNeverHoldTheSameChunk) {
  Pool pool(40 * Pool::kChunkBytes);
  std::atomic<int> wrong{0};
  const auto use = [&](std::uint64_t own) {
    for (int round = 0; round < 2000; ++round) {
      Pool::ChunkId list = Pool::kNoChunk;
      for (int i = 0; i < 5; ++i) list = pool.take(list);
      for (Pool::ChunkId chunk = list; chunk != Pool::kNoChunk; chunk = pool.next(chunk)) {
        pool.records(chunk)[0] = own;
      }
      for (Pool::ChunkId chunk = list; chunk != Pool::kNoChunk; chunk = pool.next(chunk)) {
        if (pool.records(chunk)[0] != own) ++wrong;
      }
      pool.give_back(list);
    }
  };
  {
    std::vector<std::jthread> threads;
    for (std::uint64_t own = 0; own < 4; ++own) threads.emplace_back(use, own);
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_EQ(pool.free_chunks(), 40U);
}

}  // namespace
}  // namespace atlasgauge
