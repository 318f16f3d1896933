// Generated sites of a million faces, whose answers are known in closed form.

#include "bench/site.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bench/answers.hpp"
#include "tests/support/pipeline_run.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

class MillionFacesTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    SiteOptions options;
    options.faces = 1'000'000;
    options.texture_size_texels = 8192;
    options.image_format = ImageFormat::kNone;
    dir_ = new TempDir;
    site_ = new Site(options);
    write_site(*site_, dir_->path().string());
  }
  static void TearDownTestSuite() {
    delete site_;
    delete dir_;
  }

  static PipelineResult run(std::uint64_t engine_bytes, std::size_t block_bytes,
                            const TempDir& dir = *dir_) {
    PipelineConfig config;
    config.engine_bytes = engine_bytes;
    config.block_bytes = block_bytes;
    config.resident_bytes = engine_bytes / 4;
    config.workers = 2;
    config.texture_size = ImageSize{8192, 8192};
    return run_pipeline((dir.path() / "site.obj").string(), config);
  }

  static TempDir* dir_;
  static Site* site_;
};

TempDir* MillionFacesTest::dir_ = nullptr;
Site* MillionFacesTest::site_ = nullptr;

TEST_F(MillionFacesTest, ClosedFormsHoldInFourMegabytes) {
  EXPECT_EQ(differences(run(4 * kMiB, 16 << 10).report, site_answers(*site_)),
            std::vector<std::string>{});
}

TEST_F(MillionFacesTest, FourMegabytesAndFourGigabytesGiveTheSameBytes) {
  EXPECT_EQ(run(4 * kMiB, 16 << 10).report.dump(), run(4096 * kMiB, 1 << 20).report.dump());
}

TEST_F(MillionFacesTest, EveryStageThatHoldsFacesSpillsInFourMegabytes) {
  for (const StageCost& stage : run(4 * kMiB, 16 << 10).stages) {
    if (stage.name == "boundary") continue;  // a few thousand edges
    EXPECT_GT(stage.spilled_bytes + stage.read_bytes, 0U) << stage.name;
  }
}

/// What the stages that group half-edges and corners read back.
std::uint64_t grouping_read_bytes(const PipelineResult& result) {
  std::uint64_t bytes = 0;
  for (const StageCost& stage : result.stages) {
    if (stage.name == "edges" || stage.name == "vertex stars") bytes += stage.read_bytes;
  }
  return bytes;
}

TEST_F(MillionFacesTest, HalfEdgesInOrderStayInSixtyFourMegabytes) {
  EXPECT_EQ(grouping_read_bytes(run(64 * kMiB, 64 << 10)), 0U);
}

TEST_F(MillionFacesTest, HalfEdgesInRandomOrderSpillInSixtyFourMegabytes) {
  SiteOptions options;
  options.faces = 1'000'000;
  options.texture_size_texels = 8192;
  options.image_format = ImageFormat::kNone;
  options.shuffle_seed = 3;
  const TempDir dir;
  const Site shuffled(options);
  write_site(shuffled, dir.path().string());
  const PipelineResult result = run(64 * kMiB, 64 << 10, dir);
  EXPECT_GT(grouping_read_bytes(result), 100 * shuffled.faces());
  EXPECT_EQ(differences(result.report, site_answers(shuffled)), std::vector<std::string>{});
}

TEST_F(MillionFacesTest, NothingIsSpilledInFourGigabytes) {
  for (const StageCost& stage : run(4096 * kMiB, 1 << 20).stages) {
    EXPECT_EQ(stage.spilled_bytes, 0U) << stage.name;
  }
}

TEST_F(MillionFacesTest, TwoWorkersShareTheWork) {
  std::size_t shared = 0;
  for (const StageCost& stage : run(64 * kMiB, 64 << 10).stages) {
    if (stage.workers_busy == 2) ++shared;
  }
  EXPECT_GE(shared, 4U);
}

}  // namespace
}  // namespace atlasgauge
