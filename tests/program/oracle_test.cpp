#include "tests/support/oracle.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "tests/support/oracle_comparison.hpp"
#include "tests/support/random_mesh.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

/// Runs seeds [begin, end) through both, with budgets and workers that vary with the seed.
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
    config.probe = probe_of(model.images);
    if (seed % 4 == 0) config.texture_size = ImageSize{640, 480};
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
