// Hostile models at sizes small enough for every run, in so little memory that they take the ways
// that large ones take.

#include "bench/worst_cases.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>
#include <vector>

#include "bench/answers.hpp"
#include "io/error.hpp"
#include "tests/support/pipeline_run.hpp"
#include "tests/support/temp_dir.hpp"
#include "tests/support/worst_case_names.hpp"

namespace atlasgauge {

namespace {

constexpr std::uint64_t kLittleBytes = 256 << 10;
/// At four bytes a face, labels need several rounds in so little memory.
constexpr std::uint64_t kFacesForLabels = 60'000;

PipelineConfig config_for(const WorstCase& worst_case, std::uint64_t engine_bytes) {
  PipelineConfig config;
  config.engine_bytes = engine_bytes;
  config.resident_bytes = engine_bytes / 8;
  config.workers = 2;
  config.texture_size = worst_case.texture_size;
  return config;
}

std::uint64_t small_size(const WorstCase& worst_case) {
  if (worst_case.unit == "bytes") return 100'000;
  // The names of textures have to fit in the memory, too.
  if (worst_case.name.starts_with("materials")) return 5'000;
  const bool has_far_neighbours = worst_case.name == "spiral" || worst_case.name == "duplicated" ||
                                  worst_case.name.ends_with("_shuffled");
  return has_far_neighbours ? kFacesForLabels : 30'000;
}

class WorstCaseTest : public testing::TestWithParam<WorstCase> {
 protected:
  static constexpr std::uint64_t kMuchBytes = std::uint64_t{1} << 30;

  WorstCaseTest() { write_worst_case(GetParam(), size_, dir_.path().string()); }

  PipelineResult run(std::uint64_t engine_bytes) const {
    const std::string model = (dir_.path() / GetParam().name).string() + ".obj";
    return run_pipeline(model, config_for(GetParam(), engine_bytes));
  }

  void expect_refusal() const {
    try {
      run(kLittleBytes);
      ADD_FAILURE() << "not refused";
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      EXPECT_NE(std::string(error.what()).find(GetParam().refusal), std::string::npos)
          << error.what();
    }
  }

  TempDir dir_;
  const std::uint64_t size_ = small_size(GetParam());
};

TEST_P(WorstCaseTest, HasItsClosedFormInLittleMemoryAndTheSameBytesInMuch) {
  if (!GetParam().refusal.empty()) return expect_refusal();
  const Json little = run(kLittleBytes).report;
  EXPECT_EQ(differences(little, worst_case_answers(GetParam(), size_)), std::vector<std::string>{});
  EXPECT_EQ(little.dump(), run(kMuchBytes).report.dump());
}

INSTANTIATE_TEST_SUITE_P(All, WorstCaseTest, testing::ValuesIn(worst_cases()), name_of);

TEST(WorstCases, TexturesWhoseNamesFillTheBudgetAreRefusedWithWhatWouldDo) {
  const TempDir dir;
  const WorstCase& materials = worst_case_of("materials");
  write_worst_case(materials, 40'000, dir.path().string());
  try {
    run_pipeline((dir.path() / "materials.obj").string(), config_for(materials, kLittleBytes));
    FAIL() << "not refused";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    EXPECT_NE(std::string(error.what()).find("textures"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("raise --memory"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace atlasgauge
