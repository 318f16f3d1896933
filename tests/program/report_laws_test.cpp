// One answer: what the report must not depend on.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

#include "bench/site.hpp"
#include "stream/raster/osmesa_module.hpp"
#include "tests/support/module_folder.hpp"
#include "tests/support/oracle_comparison.hpp"
#include "tests/support/pipeline_run.hpp"
#include "tests/support/random_mesh.hpp"
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

/// A model to be rastered, with the images that it names.
struct DrawnModel {
  std::string obj, mtl;
  ImageSizes images;
  std::optional<ImageSize> size_option;
};

/// Triangles of their own on two textures, one above the other, half of them mirrored, some of them
/// outside or larger than the texture.
DrawnModel crowd(std::size_t faces) {
  DrawnModel model;
  model.mtl = "newmtl a\nmap_Kd a.png\nnewmtl b\nmap_Kd b.png\n";
  model.images = {{"a.png", {300, 500}}, {"b.png", {1024, 100}}};
  std::mt19937 random(5);
  const auto between = [&](int low, int high) {
    return low + static_cast<int>(random() % static_cast<unsigned>(high - low));
  };
  model.obj = "mtllib crowd.mtl\n";
  for (std::size_t i = 0; i < faces; ++i) {
    const int reach = i % 50 == 0 ? 3000 : 100;
    const int u = between(-100, 1100), v = between(-100, 1100);
    for (int k = 0; k < 3; ++k) {
      model.obj += "v " + std::to_string(i) + ' ' + std::to_string(k % 2) + ' ' +
                   std::to_string(k / 2) + "\nvt " +
                   std::to_string(0.001 * (u + between(-reach, reach))) + ' ' +
                   std::to_string(0.001 * (v + between(-reach, reach))) + '\n';
    }
    model.obj += i % 3 == 0 ? "usemtl b\n" : "usemtl a\n";
    model.obj += "f -3/-3 -2/-2 -1/-1\n";
  }
  return model;
}

DrawnModel random_drawn_model(std::uint64_t seed) {
  oracle::RandomModel random = oracle::random_model(seed, {.mtl_name = "crowd.mtl"});
  DrawnModel model{random.obj, random.mtl, random.images, {}};
  if (random.size_option) {
    model.size_option = ImageSize{random.size_option->first, random.size_option->second};
  }
  return model;
}

std::string write(const TempDir& dir, const DrawnModel& model) {
  for (const auto& image : model.images) dir.write(image.first, "");
  dir.write("crowd.mtl", model.mtl);
  return dir.write("crowd.obj", model.obj);
}

/// A side of tiles, and budgets that they fit.
struct TileKnobs {
  std::int64_t tile_size;
  std::vector<std::uint64_t> engine_bytes;
};

/// Parameters: the raster, and the number of workers.
class RasterLawTest : public testing::TestWithParam<std::tuple<RasterChoice, std::size_t>> {
 protected:
  static void SetUpTestSuite() { show_modules(kOsmesaModuleFile); }

  RasterChoice raster() const { return std::get<0>(GetParam()); }
  std::size_t workers() const { return std::get<1>(GetParam()); }

  PipelineConfig varied(PipelineConfig config) const {
    config.raster = raster();
    config.workers = workers();
    return config;
  }

  void expect_same_bytes(const std::string& model, const PipelineConfig& plain,
                         const std::vector<TileKnobs>& all_knobs) const {
    const std::string want = text_of(run_pipeline(model, plain));
    PipelineConfig config = varied(plain);
    for (const TileKnobs& knobs : all_knobs) {
      config.tile_size = knobs.tile_size;
      for (const std::uint64_t engine_bytes : knobs.engine_bytes) {
        SCOPED_TRACE("tiles of " + std::to_string(knobs.tile_size) + ", engine of " +
                     std::to_string(engine_bytes >> 10) + " KiB");
        config.engine_bytes = engine_bytes;
        config.resident_bytes = engine_bytes / 8;
        const PipelineResult result = run_pipeline(model, config);
        EXPECT_EQ(text_of(result), want);
        expect_drawn_as_told(result.raster);
      }
    }
  }

  /// OSMesa leaves what it cannot draw to the scalar raster.
  void expect_drawn_as_told(const RasterWork& work) const {
    if (raster() == RasterChoice::kOsmesa) return;
    EXPECT_EQ(work.triangles.osmesa, 0U);
  }

  TempDir dir_;
};

TEST_P(RasterLawTest, BytesOfASiteDoNotDependOnTiles) {
  SiteOptions site = small_site();
  site.faces = 10'000;
  site.texture_size_texels = 512;
  expect_same_bytes(make(dir_, site), config_for(site),
                    {{8, {2 * kMiB}},
                     {16, {kMiB, 64 * kMiB}},
                     {64, {kMiB, 64 * kMiB}},
                     {512, {16 * kMiB}},
                     {0, {kMiB, 64 * kMiB}}});
}

TEST_P(RasterLawTest, BytesOfACrowdDoNotDependOnTiles) {
  const DrawnModel model = crowd(1000);
  PipelineConfig config;
  config.probe = probe_of(model.images);
  expect_same_bytes(write(dir_, model), config,
                    {{8, {2 * kMiB}},
                     {16, {kMiB}},
                     {64, {512 << 10, 64 * kMiB}},
                     {512, {24 * kMiB}},
                     {0, {kMiB}}});
}

TEST_P(RasterLawTest, BytesOfRandomModelsDoNotDependOnTiles) {
  for (std::uint64_t seed = 1000; seed < 1006; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const DrawnModel model = random_drawn_model(seed);
    PipelineConfig config;
    config.probe = probe_of(model.images);
    config.texture_size = model.size_option;
    expect_same_bytes(write(dir_, model), config, {{8, {kMiB}}, {0, {kMiB}}});
  }
}

TEST_P(RasterLawTest, TilesAreDrawnByTheRasterThatWasNamed) {
  SiteOptions site = small_site();
  site.faces = 10'000;
  site.texture_size_texels = 1024;
  PipelineConfig config = varied(config_for(site));
  config.tile_size = 64;
  const PipelineResult result = run_pipeline(make(dir_, site), config);
  EXPECT_EQ(result.raster.tile_size, 64);
  EXPECT_GT(result.raster.tiles, 64U);  // squares of the largest level
  const RasterTally& drawn = result.raster.triangles;
  const bool is_osmesa = raster() == RasterChoice::kOsmesa;
  EXPECT_GE(is_osmesa ? drawn.osmesa : drawn.scalar, result.report.at("fn").get<std::uint64_t>());
  EXPECT_EQ(is_osmesa ? drawn.scalar : drawn.osmesa, 0U);
  const auto stage = std::ranges::find(result.stages, "raster", &StageCost::name);
  ASSERT_NE(stage, result.stages.end());
  EXPECT_GE(stage->workers_busy, std::min<std::size_t>(2, workers()));
}

std::string name_of_raster(
    const testing::TestParamInfo<std::tuple<RasterChoice, std::size_t>>& info) {
  const auto [raster, workers] = info.param;
  return (raster == RasterChoice::kOsmesa ? "Osmesa" : "Scalar") + std::to_string(workers);
}

INSTANTIATE_TEST_SUITE_P(All, RasterLawTest,
                         testing::Combine(testing::Values(RasterChoice::kScalar,
                                                          RasterChoice::kOsmesa),
                                          testing::Values(1, 2, 3)),
                         name_of_raster);

}  // namespace
}  // namespace atlasgauge
