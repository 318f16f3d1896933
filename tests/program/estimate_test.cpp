// What --estimate says against what the run then uses.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bench/site.hpp"
#include "io/bytes.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

struct Case {
  const char* name;
  std::uint64_t faces;
  std::uint32_t textures = 1;
  ImageFormat format = ImageFormat::kNone;
  bool duplicate_vertices = false;
  bool shuffled = false;
};

class EstimateCase : public testing::TestWithParam<Case> {};

/// The bytes that `-v` prints after `what`.
double bytes_of(const std::string& text, const std::string& what) {
  const std::size_t begin = text.find_first_not_of(' ', text.find(what) + what.size());
  const std::size_t unit = text.find(' ', begin) + 1;
  const double number = std::stod(text.substr(begin));
  const std::string name = text.substr(unit, text.find(' ', unit) - unit);
  return number * static_cast<double>(parse_bytes("1" + name));
}

// In order, half-edges and corners hardly reach scratch, which no estimate may count on.
TEST_P(EstimateCase, IsWithinAHalfOfWhatTheRunUsesOrMoreInOrder) {
  const Case& model = GetParam();
  const TempDir dir;
  SiteOptions options;
  options.faces = model.faces;
  options.textures = model.textures;
  options.texture_size_texels = 1024;
  options.image_format = model.format;
  options.duplicate_vertices = model.duplicate_vertices;
  if (model.shuffled) options.shuffle_seed = 3;
  write_site(Site(options), dir.path().string());
  std::vector<std::string> arguments{
      (dir.path() / "site.obj").string(), "-t", "1024x1024", "--memory", "300M", "-q"};

  std::vector<std::string> estimate_arguments = arguments;
  for (const char* more : {"--estimate", "--json", "-"}) estimate_arguments.emplace_back(more);
  const ProgramResult estimate = run_program(ATLASGAUGE_PROGRAM, estimate_arguments);
  ASSERT_EQ(estimate.exit_code, 0) << estimate.err;
  const nlohmann::json cost = nlohmann::json::parse(estimate.out);
  arguments.emplace_back("-v");
  const ProgramResult run = run_program(ATLASGAUGE_PROGRAM, arguments);
  ASSERT_EQ(run.exit_code, 0) << run.err;

  const double most = model.shuffled ? 1.5 : 2.5;
  const auto expect_close = [most](double estimated, double used) {
    EXPECT_LT(estimated, most * used);
    EXPECT_GT(estimated, used / 1.5);
  };
  expect_close(cost.at("scratch_bytes").get<double>(), bytes_of(run.err, "scratch alive at once"));
  expect_close(cost.at("memory_bytes").get<double>(), bytes_of(run.err, "peak resident"));
  EXPECT_EQ(cost.at("time_class"), "seconds");
}

INSTANTIATE_TEST_SUITE_P(
    Sites, EstimateCase,
    testing::Values(Case{"Small", 1'000}, Case{"Medium", 60'000}, Case{"Spilling", 400'000},
                    Case{"Duplicated", 400'000, 1, ImageFormat::kNone, true},
                    Case{"Shuffled", 400'000, 1, ImageFormat::kNone, false, true},
                    Case{"Images", 100'000, 2, ImageFormat::kPng}),
    [](const auto& model) { return model.param.name; });

TEST(EstimateCommandTest, PrintsCountsMemoryScratchAndTime) {
  const TempDir dir;
  const std::string model = dir.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProgramResult run = run_program(ATLASGAUGE_PROGRAM, {"--estimate", model});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  for (const char* word : {"faces", "counted", "memory", "scratch", "time"}) {
    EXPECT_NE(run.out.find(word), std::string::npos) << word;
  }
}

TEST(EstimateCommandTest, MissingModelExitsWithThree) {
  EXPECT_EQ(run_program(ATLASGAUGE_PROGRAM, {"--estimate", "/no/such/model.obj"}).exit_code, 3);
}

}  // namespace
}  // namespace atlasgauge
