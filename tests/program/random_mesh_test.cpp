// What the random models hold: a comparison on models without a feature would prove nothing of it.

#include "tests/support/random_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/oracle_comparison.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using nlohmann::json;

/// Whether some texture has more than none of a count, at level 0 or further down.
bool has_texels(const json& report, const char* count, std::size_t first_level = 0) {
  for (const auto& [key, levels] : report.items()) {
    if (!key.starts_with("texture_")) continue;
    for (std::size_t level = first_level; level < levels.size(); ++level) {
      if (levels[level].at(count).is_number() && levels[level].at(count) > 0) return true;
    }
  }
  return false;
}

bool has_texture(const json& report, const std::function<bool(const json& levels)>& of_kind) {
  for (const auto& [key, levels] : report.items()) {
    if (key.starts_with("texture_") && of_kind(levels)) return true;
  }
  return false;
}

bool is_odd_and_not_square(const json& levels) {
  return !levels.empty() && levels[0].at("rw") != levels[0].at("rh") &&
         levels[0].at("rw").get<int>() % 2 == 1;
}

json oracle_report(std::uint64_t seed) {
  const TempDir dir;
  const oracle::RandomModel model = oracle::random_model(seed);
  dir.write("random.mtl", model.mtl);
  for (const auto& image : model.images) dir.write(image.first, "");
  PipelineConfig config;
  const ComputedImages images = random_images(model.images, seed);
  config.probe = images.probe();
  if (!model.reaches_long) config.open_image = images.open();
  if (const auto size = model.size_option) {
    config.texture_size = ImageSize{size->first, size->second};
  }
  return *oracle_outcome(dir.write("random.obj", model.obj), config).report;
}

bool has_listed_seam(const json& report, const std::function<bool(const json& seam)>& of_kind) {
  const json& seams = report.at("worst_seams");
  return std::any_of(seams.begin(), seams.end(), of_kind);
}

bool is_between_textures(const json& seam) {
  return seam.at("sides")[0].at("texture") != seam.at("sides")[1].at("texture");
}

bool starts_outside(const json& seam) {
  const json& uv = seam.at("sides")[0].at("uv_from");
  return uv[0] < 0 || uv[0] > 1 || uv[1] < 0 || uv[1] > 1;
}

/// Whether there are seams that have colours, but no samples.
bool has_seams_without_samples(const json& report) {
  const std::size_t listed = report.at("worst_seams").size();
  return listed < 20 && listed + report.at("seam_edges_unsampled").get<std::size_t>() <
                            report.at("seam_edges").get<std::size_t>();
}

std::map<std::string, bool> features_of(const json& report) {
  return {
      {"overlap within a chart", report.at("overlap_within_chart_texels") > 0},
      {"overlap between charts", report.at("overlap_between_charts_texels") > 0},
      {"occupancy above a half", report.at("occupancy") > 0.5},
      {"occupancy of less than all",
       report.at("occupancy") < 1 && !report.at("occupancy").is_null()},
      {"null occupancy", report.at("occupancy").is_null()},
      {"clashes", has_texels(report, "texelClashes")},
      {"clashes further down", has_texels(report, "texelClashes", 2)},
      {"texels lost further down", has_texels(report, "lostTexels", 2)},
      {"faces cut from sf", report.at("sf_discardedArea") > 0},
      {"faces too far out", report.at("uv_far") > 0},
      {"UVs outside", report.at("faces_uv_outside") > 0},
      {"folds", report.at("nfolds") > 0},
      {"seams of different colours", report.at("seam_discrepancy_max") > 0},
      {"seams between textures", has_listed_seam(report, is_between_textures)},
      {"seams that repeat a texture", has_listed_seam(report, starts_outside)},
      {"seams without samples", has_seams_without_samples(report)},
      {"seams without colours", report.at("seam_edges_unsampled") > 0},
      {"more seams than are listed", report.at("worst_seams").size() == 20},
      {"a texture without a size",
       has_texture(report, [](const json& levels) { return levels.empty(); })},
      {"a texture of one texel", has_texture(report,
                                             [](const json& levels) {
                                               return levels.size() == 1 && levels[0].at("rw") == 1;
                                             })},
      {"a texture of six levels",
       has_texture(report, [](const json& levels) { return levels.size() >= 6; })},
      {"a texture of odd sides", has_texture(report, is_odd_and_not_square)},
  };
}

TEST(RandomMeshTest, OneModelInTwentyHasEachFeature) {
  constexpr int kModels = 200;
  std::map<std::string, int> models;
  for (std::uint64_t seed = 0; seed < kModels; ++seed) {
    for (const auto& [feature, present] : features_of(oracle_report(seed))) {
      models[feature] += present;
    }
  }
  for (const auto& [feature, count] : models) {
    EXPECT_GE(count, kModels / 20) << feature;
  }
}

}  // namespace
}  // namespace atlasgauge
