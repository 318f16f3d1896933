#include "tests/support/oracle/oracle.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

#include "tests/support/oracle_comparison.hpp"
#include "tests/support/random_mesh.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

/// Runs seeds [begin, end) through both, with budgets, workers and tiles that vary with the seed.
void compare_seeds(std::uint64_t begin, std::uint64_t end) {
  for (std::uint64_t seed = begin; seed < end; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TempDir dir;
    const oracle::RandomModel model = oracle::random_model(seed);
    const std::string path = dir.write("random.obj", model.obj);
    dir.write("random.mtl", model.mtl);
    for (const auto& image : model.images) dir.write(image.first, "");
    PipelineConfig config;
    config.workers = 1 + seed % 3;
    config.engine_bytes = seed % 2 == 0 ? 2 << 20 : 1 << 20;
    config.tile_size = std::array{0, 1, 3, 8, 16}[seed % 5];
    config.texmetro_seams = seed % 2 == 0;
    const ComputedImages images = random_images(model.images, seed);
    config.probe = images.probe();
    if (!model.reaches_long) config.open_image = images.open();
    if (const auto size = model.size_option) {
      config.texture_size = ImageSize{size->first, size->second};
    }
    const Outcome want = oracle_outcome(path, config);
    ASSERT_TRUE(want.report) << want.refusal;
    for (const std::string& text : contradictions(pipeline_outcome(path, config), want)) {
      ADD_FAILURE() << text;
    }
  }
}

TEST(OracleTest, RandomModelsAgreeOnEveryKey) {
  compare_seeds(0, 600);
}

}  // namespace
}  // namespace atlasgauge
