// Both rasters on real models, as a user runs the program.

#include <gtest/gtest.h>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/image/image_reader.hpp"
#include "stream/raster/osmesa_module.hpp"
#include "stream/raster/raster.hpp"
#include "tests/support/module_folder.hpp"
#include "tests/support/pipeline_run.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

/// What -v says that a raster drew, as in "triangles drawn: 0 scalar, 12 osmesa".
RasterTally tally_in(const std::string& text) {
  RasterTally tally;
  const std::size_t at = text.find("triangles drawn: ");
  if (at == std::string::npos) return tally;
  std::string words, scalar;
  std::istringstream(text.substr(at)) >> words >> words >> tally.scalar >> scalar >> tally.osmesa;
  return tally;
}

/// In the folder beside the checkout; empty where it is not at hand.
std::set<fs::path> real_models() {
  const fs::path folder = fs::path(ATLASGAUGE_SOURCE_DIR).parent_path() / "shared/data";
  std::set<fs::path> models;
  if (!fs::exists(folder)) return models;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() == ".obj") models.insert(entry.path());
  }
  return models;
}

class RealModelsTest : public testing::Test {
 protected:
  std::string report_path(const char* raster) const {
    return (dir_.path() / raster).string() + ".json";
  }

  /// The least memory that OSMesa may be given. The size is for textures that cannot be read.
  ProgramResult run(const fs::path& model, const char* raster) const {
    return run_program(ATLASGAUGE_PROGRAM,
                       {model.string(), "-q", "-v", "-t", "100x75", "--memory", "448M", "--raster",
                        raster, "--json", report_path(raster)});
  }

  std::string report(const char* raster) const {
    std::ifstream file(report_path(raster), std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  TempDir dir_;
};

TEST_F(RealModelsTest, BothRastersGiveTheSameBytesWithinTheLimit) {
  const std::set<fs::path> models = real_models();
  if (models.empty()) GTEST_SKIP() << "SKIPPED: no models beside this checkout";
  int measured = 0;
  RasterTally by_scalar, by_osmesa;
  for (const fs::path& model : models) {
    SCOPED_TRACE(model);
    const ProgramResult scalar = run(model, "scalar");
    const ProgramResult osmesa = run(model, "osmesa");
    ASSERT_EQ(osmesa.exit_code, scalar.exit_code) << osmesa.err;
    EXPECT_TRUE(ATLASGAUGE_SANITIZED || osmesa.peak_resident_kib <= 448 << 10)
        << osmesa.peak_resident_kib << " KiB";
    if (osmesa.exit_code != 0) continue;
    ++measured;
    by_scalar.merge(tally_in(scalar.err));
    by_osmesa.merge(tally_in(osmesa.err));
    EXPECT_EQ(report("osmesa"), report("scalar"));
  }
  EXPECT_GT(measured, 100);
  EXPECT_EQ(by_scalar.osmesa, 0U);
  EXPECT_GT(by_scalar.scalar, 100'000U);
  EXPECT_GT(by_osmesa.osmesa, 1000 * by_osmesa.scalar) << "but for some that reach far out";
  EXPECT_GT(by_osmesa.osmesa, 100'000U);
}

TEST_F(RealModelsTest, BothRastersAgreeOnEveryTexel) {
  const std::set<fs::path> models = real_models();
  if (models.empty()) GTEST_SKIP() << "SKIPPED: no models beside this checkout";
  show_modules(kOsmesaModuleFile);
  PipelineConfig config;
  config.texture_size = ImageSize{100, 75};
  config.probe = read_image_header;
  config.open_image = open_image;
  config.both_rasters = true;
  config.tile_size = 512;
  std::uint64_t drawn = 0;
  for (const fs::path& model : models) {
    SCOPED_TRACE(model);
    try {
      drawn += run_pipeline(model.string(), config).raster.triangles.osmesa;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput) << error.what();
    }
  }
  EXPECT_GT(drawn, 100'000U);
}

}  // namespace
}  // namespace atlasgauge
