// One answer: what the report must not depend on.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "bench/site.hpp"
#include "tests/support/pipeline_run.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

SiteOptions small_site() {
  SiteOptions options;
  options.faces = 40'000;
  options.texture_size_texels = 2048;
  options.image_format = ImageFormat::kNone;
  return options;
}

std::string make(const TempDir& dir, const SiteOptions& options) {
  const Site site(options);
  write_site(site, dir.path().string());
  return (dir.path() / (options.name + ".obj")).string();
}

PipelineConfig config_for(const SiteOptions& site) {
  PipelineConfig config;
  config.texture_size = ImageSize{site.texture_size_texels, site.texture_size_texels};
  return config;
}

std::string text_of(const PipelineResult& result) {
  return result.report.dump();
}

struct Knobs {
  std::uint64_t engine_bytes, resident_bytes;
  std::size_t block_bytes, workers;
};

class ReportLawTest : public testing::TestWithParam<bool> {};

TEST_P(ReportLawTest, BytesDoNotDependOnBudgetThreadsOrBlocks) {
  const TempDir dir;
  SiteOptions site = small_site();
  site.duplicate_vertices = GetParam();
  site.shuffle_seed = GetParam() ? std::optional<std::uint64_t>(7) : std::nullopt;
  const std::string model = make(dir, site);
  PipelineConfig config = config_for(site);
  const std::string want = text_of(run_pipeline(model, config));
  for (const Knobs& knobs : {Knobs{1 * kMiB, 0, 4096, 1}, Knobs{1 * kMiB, 64 << 10, 4096, 2},
                             Knobs{1536 << 10, 0, 4096, 3}, Knobs{4 * kMiB, 1 * kMiB, 16384, 2},
                             Knobs{256 * kMiB, 128 * kMiB, 1 << 20, 3}}) {
    config.engine_bytes = knobs.engine_bytes;
    config.resident_bytes = knobs.resident_bytes;
    config.block_bytes = knobs.block_bytes;
    config.workers = knobs.workers;
    SCOPED_TRACE(std::to_string(knobs.engine_bytes) + " bytes, " + std::to_string(knobs.workers));
    EXPECT_EQ(text_of(run_pipeline(model, config)), want);
  }
}

INSTANTIATE_TEST_SUITE_P(PlainAndShuffledWelded, ReportLawTest, testing::Bool());

TEST(ReportLawTest, FaceOrderDoesNotShow) {
  const TempDir dir;
  SiteOptions site = small_site();
  const std::string in_order = text_of(run_pipeline(make(dir, site), config_for(site)));
  site.shuffle_seed = 3;
  EXPECT_EQ(text_of(run_pipeline(make(dir, site), config_for(site))), in_order);
}

TEST(ReportLawTest, DuplicatedVerticesChangeOnlyTheRawLevel) {
  const TempDir dir;
  SiteOptions site = small_site();
  const Json shared = run_pipeline(make(dir, site), config_for(site)).report;
  site.duplicate_vertices = true;
  const Json duplicated = run_pipeline(make(dir, site), config_for(site)).report;
  EXPECT_NE(duplicated.at("vndup"), shared.at("vndup"));
  for (const char* key : {"fn", "area", "en_uv", "en_uv_b", "area_uv", "boundary_len_uv",
                          "num_charts", "seam_edges", "seam_len", "nfolds", "mapped_fraction",
                          "qcd_avg", "qcd_perc50", "texel_density_perc90", "angle_min_perc1"}) {
    EXPECT_EQ(duplicated.at(key), shared.at(key)) << key;
  }
}

TEST(ReportLawTest, PeakReservedStaysUnderTheBudget) {
  const TempDir dir;
  const SiteOptions site = small_site();
  PipelineConfig config = config_for(site);
  config.engine_bytes = 1 * kMiB;
  config.workers = 2;
  EXPECT_LE(run_pipeline(make(dir, site), config).peak_reserved_bytes, config.engine_bytes);
}

}  // namespace
}  // namespace atlasgauge
