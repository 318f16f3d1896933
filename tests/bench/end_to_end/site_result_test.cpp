#include "bench/end_to_end/site_result.hpp"

#include <gtest/gtest.h>

namespace atlasgauge {
namespace {

RunFigures run_of(double seconds, double peak_bytes) {
  RunFigures run;
  run.wall_seconds = seconds;
  run.user_seconds = 2 * seconds;
  run.system_seconds = 0.5;
  run.peak_resident_bytes = peak_bytes;
  run.cost.stages = {{.name = "read", .wall_seconds = seconds / 2, .cpu_seconds = seconds}};
  run.cost.bytes = {{"scratch written", peak_bytes}, {"scratch read", 10}};
  return run;
}

TEST(SiteResultTest, EveryFigureIsAMedianForItself) {
  const RunFigures median = median_of({run_of(1, 500), run_of(5, 100), run_of(2, 300)});
  EXPECT_EQ(median.wall_seconds, 2);
  EXPECT_EQ(median.user_seconds, 4);
  EXPECT_EQ(median.peak_resident_bytes, 300);
  EXPECT_EQ(median.cost.stages[0].wall_seconds, 1);
  EXPECT_EQ(median.cost.stages[0].cpu_seconds, 2);
  EXPECT_EQ(median.cost.bytes_of("scratch written"), 300);
}

TEST(SiteResultTest, MedianOfTwoRunsIsTheirMean) {
  EXPECT_EQ(median_of({run_of(1, 0), run_of(4, 0)}).wall_seconds, 2.5);
}

SiteResult result_of(std::uint64_t threads, double seconds) {
  SiteResult result;
  result.site.faces = 1'000'000;
  result.site.obj_bytes = 72 << 20;
  result.budget_bytes = 256 << 20;
  result.threads = threads;
  result.runs = {run_of(seconds, 1 << 20)};
  return result;
}

TEST(SiteResultTest, StageTableHasTheRatioOfFirstToLast) {
  const std::string table = stage_table_of({result_of(1, 8), result_of(2, 5)});
  EXPECT_NE(table.find("1.60"), std::string::npos) << table;
  EXPECT_EQ(stage_table_of({result_of(1, 8)}).find("ratio"), std::string::npos);
}

TEST(SiteResultTest, CostPerFaceIsCpuOfUserAndSystem) {
  const std::string table = table_of({result_of(1, 8)});
  EXPECT_NE(table.find("16.500"), std::string::npos) << table;  // 16.5 s for a million faces
  EXPECT_NE(table.find("125000"), std::string::npos) << table;  // faces a second, by the wall
}

TEST(SiteResultTest, JsonHasEveryRun) {
  SiteResult result = result_of(2, 1);
  result.runs.push_back(run_of(3, 0));
  const nlohmann::json json = to_json(result);
  EXPECT_EQ(json.at("runs").size(), 2U);
  EXPECT_EQ(json.at("median").at("wall_seconds"), 2);
  EXPECT_EQ(json.at("runs").at(1).at("stages").at(0).at("name"), "read");
}

}  // namespace
}  // namespace atlasgauge
