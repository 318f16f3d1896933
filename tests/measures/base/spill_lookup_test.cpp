#include "measures/base/spill_lookup.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

/// Blocks of 512 records, those in memory and those on disk; the last one has a single record.
TEST(SpillLookupTest, FindsEveryRecordInAnyOrder) {
  TestEngine engine({.resident_bytes = 8192});
  std::vector<std::uint64_t> records(2561);
  std::iota(records.begin(), records.end(), 7);
  const Spill<std::uint64_t> spill = spill_of(engine, records);
  ASSERT_EQ(spill.block_count(), 6U);
  SpillLookup<std::uint64_t> lookup(spill);
  for (std::uint64_t i = 0; i < records.size(); ++i) {
    const std::uint64_t at = i * 1000 % records.size();
    EXPECT_EQ(lookup.at(at), at + 7);
  }
}

}  // namespace
}  // namespace atlasgauge
