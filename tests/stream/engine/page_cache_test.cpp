#include "stream/engine/page_cache.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <vector>

#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

/// 24 bytes: 512 of them are a page of three I/O units.
struct Pebble {
  std::uint64_t number, a, b;
};

std::vector<Pebble> pebbles(std::uint64_t count) {
  std::vector<Pebble> list;
  for (std::uint64_t i = 0; i < count; ++i) list.push_back({i, 2 * i, 3 * i});
  return list;
}

TEST(PageTagsTest, HoldsOnePageASet) {
  PageTags tags(4);
  EXPECT_FALSE(tags.access(1));
  EXPECT_TRUE(tags.access(1));
  EXPECT_FALSE(tags.access(2));
  EXPECT_TRUE(tags.access(1));
  EXPECT_FALSE(tags.access(5));  // the set of page 1
  EXPECT_FALSE(tags.access(1));
}

TEST(PageTagsTest, ThereIsAlwaysASet) {
  PageTags tags(0);
  EXPECT_FALSE(tags.access(0));
  EXPECT_TRUE(tags.access(0));
}

TEST(PageLayoutTest, PagesEndAtBlockEnds) {
  TestEngine engine({.block_bytes = 16384});  // 682 pebbles: a page of 512 and one of 170
  const Spill<Pebble> table = spill_of(engine, pebbles(2000));
  const PageLayout<Pebble> layout(table);
  EXPECT_EQ(layout.page_of(0), 0U);
  EXPECT_EQ(layout.page_of(511), 0U);
  EXPECT_EQ(layout.page_of(512), 1U);
  EXPECT_EQ(layout.in_page(512), 0U);
  EXPECT_EQ(layout.page_of(681), 1U);
  EXPECT_EQ(layout.page_of(682), 2U);
  EXPECT_EQ(layout.in_page(682), 0U);
}

TEST(PageLayoutTest, PagesForNeighboursAreLargeWhereThereIsRoomForHundreds) {
  using Layout = PageLayout<Pebble>;
  EXPECT_EQ(Layout::records_for_neighbours(0), 512U);
  EXPECT_EQ(Layout::records_for_neighbours(256 * 2 * 12288 - 1), 512U);
  EXPECT_EQ(Layout::records_for_neighbours(256 * 2 * 12288), 1024U);
  EXPECT_EQ(Layout::records_for_neighbours(std::uint64_t{1} << 40), 4096U);
}

class PageCacheTest : public testing::TestWithParam<std::tuple<std::size_t, std::uint64_t>> {};
INSTANTIATE_TEST_SUITE_P(BlocksAndMemory, PageCacheTest,
                         testing::Combine(testing::Values(4096, 12288, 16384, 65536),
                                          testing::Values(0, 20000, 100000, 10000000)));

TEST_P(PageCacheTest, FindsEveryRecordInAnyOrder) {
  const auto [block_bytes, memory_bytes] = GetParam();
  for (const std::uint64_t resident : {0, 1 << 16, 1 << 20}) {
    TestEngine engine({.block_bytes = block_bytes, .resident_bytes = resident});
    const Spill<Pebble> table = spill_of(engine, pebbles(5000));
    for (const std::uint32_t page_records : {512, 2048}) {
      PageCache<Pebble> cache(table, memory_bytes, page_records);
      std::mt19937 random(3);
      std::uniform_int_distribution<std::uint32_t> any(0, 4999);
      for (int i = 0; i < 2000; ++i) {
        const std::uint32_t record = any(random);
        ASSERT_EQ(cache.at(record).number, record);
        ASSERT_EQ(cache.at(record).b, 3U * record);
      }
      EXPECT_EQ(cache.at(4999).number, 4999U);
    }
  }
}

TEST(PageCacheReadsTest, NeighboursAreReadOnce) {
  TestEngine engine({.block_bytes = 12288});
  const Spill<Pebble> table = spill_of(engine, pebbles(5120));
  PageCache<Pebble> cache(table, 10 * 12288);
  for (int round = 0; round < 2; ++round) {
    for (std::uint32_t i = 0; i < 5120; ++i) cache.at(i);
  }
  EXPECT_EQ(engine.scratch.read_bytes(), 10 * 12288U);
  EXPECT_EQ(cache.read_bytes(), 10 * 12288U);
}

TEST(PageCacheReadsTest, ResidentBlocksAreReadInPlace) {
  TestEngine engine({.block_bytes = 12288, .resident_bytes = 1 << 20});
  const Spill<Pebble> table = spill_of(engine, pebbles(5120));
  PageCache<Pebble> cache(table, 12288);
  for (std::uint32_t i = 0; i < 5120; i += 100) cache.at(i);
  EXPECT_EQ(engine.scratch.read_bytes(), 0U);
  EXPECT_EQ(cache.read_bytes(), 0U);
}

}  // namespace
}  // namespace atlasgauge
