#include "stream/memory_plan.hpp"

#include <gtest/gtest.h>

#include <string>

#include "io/error.hpp"
#include "io/ids.hpp"
#include "stream/engine/labels.hpp"
#include "stream/raster/osmesa_raster.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

MemoryWishes limit_of(std::uint64_t bytes) {
  return {.limit_bytes = bytes, .engine_bytes = {}, .block_bytes = {}, .threads = 0};
}
MemoryWishes osmesa_in(std::uint64_t bytes) {
  MemoryWishes wishes = limit_of(bytes);
  wishes.osmesa = true;
  return wishes;
}
MemoryWishes engine_of(std::uint64_t bytes) {
  return {.limit_bytes = 512 * kMiB, .engine_bytes = bytes, .block_bytes = {}, .threads = 0};
}
MemoryWishes block_of(std::uint64_t bytes) {
  return {.limit_bytes = 512 * kMiB, .engine_bytes = {}, .block_bytes = bytes, .threads = 0};
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

TEST(MemoryPlanTest, BlocksAreA512thOfTheEngine) {
  EXPECT_EQ(plan_memory(engine_of(2 * kMiB), 1).block_bytes, 4096U);
  EXPECT_EQ(plan_memory(engine_of(8 * kMiB - 1), 1).block_bytes, 8192U);
  EXPECT_EQ(plan_memory(engine_of(8 * kMiB), 1).block_bytes, 16384U);
  EXPECT_EQ(plan_memory(engine_of(256 * kMiB), 1).block_bytes, kMiB / 2);
  EXPECT_EQ(plan_memory(engine_of(4096 * kMiB), 1).block_bytes, kMiB);
}

TEST(MemoryPlanTest, LabelsOfTheLargestModelFitInTheFloor) {
  for (std::uint64_t mib = 256; mib < 2048; mib += 16) {
    const MemoryPlan plan = plan_memory(limit_of(mib * kMiB), 2);
    EXPECT_GE(label_capacity(plan.engine_bytes - plan.resident_bytes, plan.block_bytes),
              kMaxElements)
        << mib;
  }
}

TEST(MemoryPlanTest, OneThreadPerCpuAsFarAsMemoryGoes) {
  EXPECT_EQ(plan_memory(limit_of(1024 * kMiB), 16).workers, 16U);
  EXPECT_EQ(plan_memory(limit_of(256 * kMiB), 128).workers, 10U);  // (256 - 152) / 10
}

TEST(MemoryPlanTest, ThreadsAskedForAreNotFewer) {
  MemoryWishes wishes = limit_of(512 * kMiB);
  wishes.threads = 100;
  EXPECT_EQ(plan_memory(wishes, 2).workers, 100U);
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
  MemoryWishes wishes = limit_of(256 * kMiB);
  wishes.threads = 100;
  const std::string text = refusal_of(wishes, 2, ErrorKind::kResource);
  EXPECT_NE(text.find("100 threads"), std::string::npos) << text;
  EXPECT_NE(text.find("416.0 MiB"), std::string::npos) << text;
  wishes.limit_bytes = 416 * kMiB;
  EXPECT_NO_THROW(plan_memory(wishes, 2));
}

TEST(MemoryPlanTest, OsmesaHasAFloorOfItsOwn) {
  EXPECT_NO_THROW(plan_memory(osmesa_in(448 * kMiB), 1));
  const std::string text = refusal_of(osmesa_in(448 * kMiB - 1), 1, ErrorKind::kResource);
  EXPECT_NE(text.find("at least 448.0 MiB"), std::string::npos) << text;
  EXPECT_NO_THROW(plan_memory(limit_of(448 * kMiB - 1), 1)) << "of no concern to the scalar raster";
}

TEST(MemoryPlanTest, OsmesaHasFewerThreadsUnlessTheyAreAskedFor) {
  const std::size_t scalar = plan_memory(limit_of(1024 * kMiB), 64).workers;
  const std::size_t osmesa = plan_memory(osmesa_in(1024 * kMiB), 64).workers;
  EXPECT_EQ(scalar, 64U);
  EXPECT_EQ(osmesa, 11U);  // (1024 - 152 - 88) / (8 + 2 + 48 + 12 * 1026 * 1026 / 2^20)
  MemoryWishes wishes = osmesa_in(1024 * kMiB);
  wishes.threads = osmesa + 1;
  EXPECT_EQ(plan_memory(wishes, 64).workers, osmesa + 1);
}

TEST(MemoryPlanTest, OsmesaTakesItsShareFromTheEngine) {
  MemoryWishes wishes = osmesa_in(512 * kMiB);
  wishes.threads = 2;
  const std::uint64_t rasters = 2 * osmesa_raster_bytes(kUsualOsmesaTile, kUsualOsmesaTile);
  const std::uint64_t osmesa = plan_memory(wishes, 2).engine_bytes;
  wishes.osmesa = false;
  EXPECT_EQ(osmesa + kOsmesaLoadedBytes + rasters, plan_memory(wishes, 2).engine_bytes);
}

TEST(MemoryPlanTest, OriginSaysWhatSetTheLimit) {
  EXPECT_EQ(plan_memory(limit_of(512 * kMiB), 1).origin, "--memory");
  const MemoryPlan detected = plan_memory({}, 1);
  EXPECT_EQ(detected.origin.rfind("0.8 of ", 0), 0U);
}

}  // namespace
}  // namespace atlasgauge
