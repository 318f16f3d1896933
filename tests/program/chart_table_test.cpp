// The table of charts, as a user asks for it.

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/support/random_mesh.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using nlohmann::json;

/// On 8 x 4 texels: a square of two faces over 4 x 2 of them, a face whose UVs are on a line, and
/// one without UVs.
constexpr const char* kThreeCharts =
    "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\n"
    "v 0 0 1\nv 2 0 1\nv 0 2 1\n"
    "v 0 0 2\nv 2 0 2\nv 0 2 2\n"
    "vt 0 0\nvt 0.5 0\nvt 0.5 0.5\nvt 0 0.5\nvt 0.75 0.5\nvt 1 0.5\n"
    "f 1/1 2/2 3/3 4/4\nf 5/3 6/5 7/6\nf 8 9 10\n";

class ChartTableTest : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (dir_.path() / name).string(); }

  std::string content(const std::string& name) const {
    std::ifstream file(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  ProgramResult run(const std::string& model, const std::string& table,
                    const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{model, "-q", "--charts", path(table)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(ATLASGAUGE_PROGRAM, arguments);
  }

  std::vector<json> rows_of(const std::string& table) const {
    std::istringstream lines(content(table));
    std::vector<json> rows;
    for (std::string line; std::getline(lines, line);) rows.push_back(json::parse(line));
    return rows;
  }

  TempDir dir_;
};

TEST_F(ChartTableTest, CsvHasARowForEachChart) {
  const ProgramResult result = run(dir_.write("a.obj", kThreeCharts), "t.csv", {"-t", "8x4"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(content("t.csv"),
            "chart,texture,faces,folds,null,orientable,area_3d,area_uv,perimeter,u_min,v_min,"
            "u_max,v_max,width,height,thinnest_side\n"
            "0,0,2,0,0,1,4.0,8.0,12.0,0.0,0.0,0.5,0.5,4.0,2.0,2.0\n"
            "2,0,1,0,1,1,2.0,0.0,8.0,0.5,0.5,1.0,0.5,4.0,0.0,0.0\n"
            "3,0,1,0,1,1,2.0,0.0,0.0,,,,,,,\n");
}

TEST_F(ChartTableTest, JsonLinesSayTheSameWithNullForWhatIsMissing) {
  const ProgramResult result = run(dir_.write("a.obj", kThreeCharts), "t.jsonl", {"-t", "8x4"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  const std::vector<json> rows = rows_of("t.jsonl");
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0], json::parse(R"({"chart": 0, "texture": 0, "faces": 2, "folds": 0, "null": 0,
      "orientable": 1, "area_3d": 4.0, "area_uv": 8.0, "perimeter": 12.0, "u_min": 0.0,
      "v_min": 0.0, "u_max": 0.5, "v_max": 0.5, "width": 4.0, "height": 2.0,
      "thinnest_side": 2.0})"));
  EXPECT_EQ(rows[1].at("perimeter"), 8.0);
  EXPECT_EQ(rows[2].at("perimeter"), 0.0);
  for (const char* key : {"u_min", "v_max", "width", "height", "thinnest_side"}) {
    EXPECT_TRUE(rows[2].at(key).is_null()) << key;
  }
}

TEST_F(ChartTableTest, RowsAddUpToTheReport) {
  std::uint64_t folds = 0, models_of_whole_faces = 0;
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const oracle::RandomModel model = oracle::random_model(seed, {.defect_chance = 0});
    dir_.write("random.mtl", model.mtl);
    const ProgramResult result = run(dir_.write("random.obj", model.obj), "t.jsonl",
                                     {"-t", "64x48", "--json", path("report.json")});
    ASSERT_EQ(result.exit_code, 0) << result.err;
    const json report = json::parse(content("report.json"));
    std::uint64_t faces = 0, null_charts = 0, folds_here = 0;
    double area_uv = 0;
    const std::vector<json> rows = rows_of("t.jsonl");
    for (const json& row : rows) {
      faces += row.at("faces").get<std::uint64_t>();
      null_charts += row.at("null").get<std::uint64_t>();
      folds_here += row.at("folds").get<std::uint64_t>();
      area_uv += row.at("area_uv").get<double>();
    }
    EXPECT_EQ(rows.size(), report.at("num_charts"));
    EXPECT_EQ(null_charts, report.at("num_null_charts"));
    EXPECT_EQ(folds_here, report.at("nfolds"));
    // Faces that a weld makes degenerate are in no chart; their area is zero.
    const auto count = [&](const char* key) { return report.at(key).get<std::uint64_t>(); };
    const std::uint64_t whole = count("fn") - count("fndegen") - count("faces_nonfinite");
    EXPECT_LE(faces, whole);
    EXPECT_GE(faces, whole - count("fnzero"));
    if (count("fnzero") == 0) ++models_of_whole_faces;
    EXPECT_NEAR(area_uv, report.at("area_uv").get<double>(), 1e-12 * area_uv);
    folds += folds_here;
  }
  EXPECT_GT(models_of_whole_faces, 2U);
  EXPECT_GT(folds, 0U) << "models without a fold prove nothing of them";
}

TEST_F(ChartTableTest, UnknownSuffixExitsWithTwoBeforeTheModelIsOpened) {
  const ProgramResult result = run(path("none.obj"), "t.txt");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_NE(result.err.find("t.txt"), std::string::npos) << result.err;
  EXPECT_FALSE(std::filesystem::exists(path("t.txt")));
}

TEST_F(ChartTableTest, FailedRunLeavesNoTableAndAnOldOneAsItWas) {
  const std::string model = dir_.write("bad.obj", std::string(kThreeCharts) + "v 1 x 0\n");
  EXPECT_EQ(run(model, "new.csv").exit_code, 3);
  EXPECT_FALSE(std::filesystem::exists(path("new.csv")));
  dir_.write("old.csv", "old");
  EXPECT_EQ(run(model, "old.csv").exit_code, 3);
  EXPECT_EQ(content("old.csv"), "old");
}

}  // namespace
}  // namespace atlasgauge
