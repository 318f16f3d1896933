#include "stream/memory_plan.hpp"

#include <gtest/gtest.h>

#include <string>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

MemoryWishes limit_of(std::uint64_t bytes) {
  return {.limit_bytes = bytes, .engine_bytes = {}, .block_bytes = {}};
}
MemoryWishes engine_of(std::uint64_t bytes) {
  return {.limit_bytes = 512 * kMiB, .engine_bytes = bytes, .block_bytes = {}};
}
MemoryWishes block_of(std::uint64_t bytes) {
  return {.limit_bytes = 512 * kMiB, .engine_bytes = {}, .block_bytes = bytes};
}

std::string refusal_of(const MemoryWishes& wishes, std::size_t workers, ErrorKind kind) {
  try {
    plan_memory(wishes, workers);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), kind);
    return error.what();
  }
  return "no refusal";
}

TEST(MemoryPlanTest, FloorIs256MiB) {
  EXPECT_EQ(plan_memory(limit_of(256 * kMiB), 2).limit_bytes, 256 * kMiB);
  const std::string text = refusal_of(limit_of(256 * kMiB - 1), 2, ErrorKind::kResource);
  EXPECT_NE(text.find("at least 256.0 MiB"), std::string::npos) << text;
}

TEST(MemoryPlanTest, EngineGetsWhatTheProcessLeaves) {
  EXPECT_EQ(plan_memory(limit_of(512 * kMiB), 2).engine_bytes, (512 - 152 - 2 * 2) * kMiB);
}

TEST(MemoryPlanTest, EngineTakesNoMoreThanMakesItFaster) {
  EXPECT_EQ(plan_memory(limit_of(64 * 1024 * kMiB), 2).engine_bytes, 1024 * kMiB);
}

TEST(MemoryPlanTest, MoreMemoryIsNeverLessEngine) {
  std::uint64_t last = 0;
  for (std::uint64_t mib = 256; mib < 4096; mib += 64) {
    const MemoryPlan plan = plan_memory(limit_of(mib * kMiB), 4);
    EXPECT_GE(plan.engine_bytes, last);
    EXPECT_LT(plan.engine_bytes, plan.limit_bytes);
    last = plan.engine_bytes;
  }
}

TEST(MemoryPlanTest, PoolIsAQuarterOfTheEngine) {
  EXPECT_EQ(plan_memory(engine_of(8 * kMiB), 1).resident_bytes, 2 * kMiB);
}

TEST(MemoryPlanTest, BlocksAreA256thOfTheEngine) {
  EXPECT_EQ(plan_memory(engine_of(2 * kMiB), 1).block_bytes, 8192U);
  EXPECT_EQ(plan_memory(engine_of(4 * kMiB - 1), 1).block_bytes, 8192U);
  EXPECT_EQ(plan_memory(engine_of(4 * kMiB), 1).block_bytes, 16384U);
  EXPECT_EQ(plan_memory(engine_of(256 * kMiB), 1).block_bytes, kMiB);
  EXPECT_EQ(plan_memory(engine_of(4096 * kMiB), 1).block_bytes, kMiB);
}

TEST(MemoryPlanTest, BlocksOfAnyMultipleOf4096MayBeAskedFor) {
  EXPECT_EQ(plan_memory(block_of(12288), 1).block_bytes, 12288U);
  for (const std::uint64_t bytes : {0U, 2048U, 4097U}) {
    EXPECT_NE(refusal_of(block_of(bytes), 1, ErrorKind::kUsage).find("multiple of 4096"),
              std::string::npos);
  }
}

TEST(MemoryPlanTest, EngineBelowTwoMiBIsRefused) {
  EXPECT_EQ(plan_memory(engine_of(2 * kMiB), 2).engine_bytes, 2 * kMiB);
  const std::string text = refusal_of(engine_of(2 * kMiB - 1), 2, ErrorKind::kResource);
  EXPECT_NE(text.find("at least 2.0 MiB"), std::string::npos) << text;
}

TEST(MemoryPlanTest, TooManyThreadsAreRefusedWithALimitThatWouldDo) {
  const std::string text = refusal_of(limit_of(256 * kMiB), 100, ErrorKind::kResource);
  EXPECT_NE(text.find("100 threads"), std::string::npos) << text;
  EXPECT_NE(text.find("416.0 MiB"), std::string::npos) << text;
  EXPECT_NO_THROW(plan_memory(limit_of(416 * kMiB), 100));
}

TEST(MemoryPlanTest, OriginSaysWhatSetTheLimit) {
  EXPECT_EQ(plan_memory(limit_of(512 * kMiB), 1).origin, "--memory");
  const MemoryPlan detected = plan_memory({}, 1);
  EXPECT_EQ(detected.origin.rfind("0.8 of ", 0), 0U);
}

}  // namespace
}  // namespace atlasgauge
