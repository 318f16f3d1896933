#include "tests/support/oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "io/error.hpp"
#include "tests/support/pipeline_run.hpp"
#include "tests/support/random_mesh.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

/// Values that divide rounded sums, or take singular values in double, agree to this.
constexpr double kRelative = 1e-11;
/// Conformality of a sliver, between 0 and 1, is what rounding left of its area.
constexpr double kConformality = 1e-14;
/// The deviation of values that are all but equal is the rounding of the values, against their rms.
constexpr double kDeviation = 1e-13;

double absolute_tolerance(const std::string& key, const nlohmann::json& all) {
  if (key.starts_with("conformality") && !key.ends_with("_var")) return kConformality;
  const std::string rms = key.substr(0, key.find_last_of('_')) + "_rms";
  const double scale = all.contains(rms) && all.at(rms).is_number() ? all.at(rms).get<double>() : 1;
  if (key.ends_with("_stddev")) return kDeviation * scale;
  if (key.ends_with("_var")) return kDeviation * scale * kDeviation * scale;
  return 0;
}

bool agree(const nlohmann::json& got, const nlohmann::json& want, double absolute) {
  if (!got.is_number_float() && !want.is_number_float()) return got == want;
  if (!got.is_number() || !want.is_number()) return false;
  const double a = got.get<double>(), b = want.get<double>();
  return std::abs(a - b) <= std::max(absolute, kRelative * std::max(std::abs(a), std::abs(b)));
}

struct Sizes {
  std::map<std::string, std::pair<std::uint32_t, std::uint32_t>> images;

  std::optional<oracle::Size> of(const std::string& path) const {
    const auto found = images.find(std::filesystem::path(path).filename().string());
    return found == images.end() ? std::nullopt : std::optional<oracle::Size>(found->second);
  }
};

ImageProbe probe_of(const Sizes& sizes) {
  return [sizes](const std::string& path) {
    const auto size = sizes.of(path);
    if (!size) throw Error(ErrorKind::kInput, path, 0, "missing");
    return ImageSize{size->first, size->second};
  };
}

/// Runs seeds [begin, end) through both, with budgets and workers that vary with the seed.
void compare_seeds(std::uint64_t begin, std::uint64_t end) {
  for (std::uint64_t seed = begin; seed < end; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const TempDir dir;
    const oracle::RandomModel model = oracle::random_model(seed);
    const std::string path = dir.write("random.obj", model.obj);
    dir.write("random.mtl", model.mtl);
    const Sizes sizes{model.images};
    for (const auto& image : model.images) dir.write(image.first, "");
    PipelineConfig config;
    config.workers = 1 + seed % 3;
    config.engine_bytes = seed % 2 == 0 ? 2 << 20 : 1 << 20;
    config.probe = probe_of(sizes);
    oracle::Options options;
    options.image_size = [&](const std::string& image) { return sizes.of(image); };
    if (seed % 4 == 0) {
      config.texture_size = ImageSize{640, 480};
      options.size_option = oracle::Size{640, 480};
    }
    const nlohmann::json want = oracle::measure_obj(path, options);
    const nlohmann::json got = run_pipeline(path, config).report;
    for (const auto& [key, value] : want.items()) {
      ASSERT_TRUE(got.contains(key)) << key;
      EXPECT_TRUE(agree(got.at(key), value, absolute_tolerance(key, want)))
          << key << " is " << got.at(key) << ", the oracle has " << value;
    }
  }
}

TEST(OracleTest, RandomModelsAgreeOnEveryKey) {
  compare_seeds(0, 600);
}

}  // namespace
}  // namespace atlasgauge
