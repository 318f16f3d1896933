#include "stream/engine/stage_log.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

TEST(StageLogTest, StagesAreListedInOrder) {
  TestEngine engine;
  { const StageLog::Stage stage(engine.log, "first"); }
  { const StageLog::Stage stage(engine.log, "second"); }
  ASSERT_EQ(engine.log.stages().size(), 2U);
  EXPECT_EQ(engine.log.stages()[0].name, "first");
  EXPECT_EQ(engine.log.stages()[1].name, "second");
}

TEST(StageLogTest, StageCountsOnlyItsOwnScratch) {
  TestEngine engine;
  const auto before = spill_of<int>(engine, {1});
  {
    const StageLog::Stage stage(engine.log, "spills");
    records_of(spill_of<int>(engine, {1, 2, 3}));
  }
  EXPECT_EQ(engine.log.stages()[0].spilled_bytes, 4096U);
  EXPECT_EQ(engine.log.stages()[0].written_bytes, 4096U);
  EXPECT_EQ(engine.log.stages()[0].read_bytes, 4096U);
}

TEST(StageLogTest, CountsTheWorkersThatWereBusy) {
  TestEngine engine({.workers = 3});
  {
    const StageLog::Stage stage(engine.log, "one item");
    engine.workers.for_each(1, [](std::size_t, std::size_t) {});
  }
  { const StageLog::Stage stage(engine.log, "idle"); }
  EXPECT_EQ(engine.log.stages()[0].workers_busy, 1U);
  EXPECT_EQ(engine.log.stages()[1].workers_busy, 0U);
}

TEST(StageLogTest, ProgressIsToldOncePerPercent) {
  TestEngine engine;
  std::vector<double> told;
  StageLog log(engine.scratch, engine.workers,
               [&](const std::string&, double fraction) { told.push_back(fraction); });
  {
    StageLog::Stage stage(log, "long", 10000);
    for (std::uint64_t done = 0; done <= 10000; ++done) stage.progress(done);
    stage.progress(20000);
  }
  ASSERT_EQ(told.size(), 101U);
  EXPECT_EQ(told.front(), 0);
  EXPECT_EQ(told.back(), 1);
}

}  // namespace
}  // namespace atlasgauge
