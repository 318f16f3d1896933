#include "bench/end_to_end/cost_text.hpp"

#include <gtest/gtest.h>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

const char* const kText =
    "warning: a.obj:3: something with 2 KiB\n"
    "\n"
    "stage            wall s    CPU s  workers      spilled      written         read\n"
    "read              0.215    0.139        2     18.2 MiB      1.5 GiB          0 B\n"
    "seam requests    12.036    0.019        1      2.0 KiB        512 B      1.0 TiB\n"
    "raster: 20 tiles of up to 512 texels, triangles drawn: 2327884 scalar, 0 osmesa\n"
    "memory limit                  256.0 MiB  --memory\n"
    "scratch alive at once         246.5 MiB  in memory and on disk\n"
    "scratch read                      3.0 B  \n";

TEST(CostTextTest, StagesHaveTheirNamesAndTimes) {
  const CostText cost = parse_cost(kText);
  ASSERT_EQ(cost.stages.size(), 2U);
  EXPECT_EQ(cost.stages[0].name, "read");
  EXPECT_EQ(cost.stages[0].wall_seconds, 0.215);
  EXPECT_EQ(cost.stages[0].cpu_seconds, 0.139);
  EXPECT_EQ(cost.stages[0].workers, 2U);
  EXPECT_EQ(cost.stages[1].name, "seam requests");
  EXPECT_EQ(cost.stages[1].wall_seconds, 12.036);
}

TEST(CostTextTest, BytesAreInTheUnitOfTheirColumn) {
  const CostText cost = parse_cost(kText);
  EXPECT_EQ(cost.stages[0].spilled_bytes, 18.2 * 1024 * 1024);
  EXPECT_EQ(cost.stages[0].written_bytes, 1.5 * 1024 * 1024 * 1024);
  EXPECT_EQ(cost.stages[0].read_bytes, 0);
  EXPECT_EQ(cost.stages[1].spilled_bytes, 2048);
  EXPECT_EQ(cost.stages[1].written_bytes, 512);
  EXPECT_EQ(cost.stages[1].read_bytes, 0x1p40);
}

TEST(CostTextTest, TotalsAreFoundByTheirWords) {
  const CostText cost = parse_cost(kText);
  EXPECT_EQ(cost.bytes_of("memory limit"), 256 * 1024 * 1024);
  EXPECT_EQ(cost.bytes_of("scratch alive at once"), 246.5 * 1024 * 1024);
  EXPECT_EQ(cost.bytes_of("scratch read"), 3);
  EXPECT_THROW(cost.bytes_of("scratch written"), Error);
}

TEST(CostTextTest, TextWithoutStagesIsAFault) {
  EXPECT_THROW(parse_cost("memory limit  256.0 MiB  --memory\n"), Error);
}

}  // namespace
}  // namespace atlasgauge
