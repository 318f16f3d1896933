#include "measures/base/report.hpp"

#include <cmath>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "stream/engine/quantiles.hpp"

namespace atlasgauge {
namespace {

using Keys = std::vector<std::string>;

void append(Keys& keys, const Keys& more) {
  keys.insert(keys.end(), more.begin(), more.end());
}

Keys moments(const std::string& prefix) {
  return {prefix + "_min", prefix + "_max", prefix + "_avg",
          prefix + "_rms", prefix + "_var", prefix + "_stddev"};
}

Keys statistics(const std::string& prefix) {
  Keys keys;
  for (const int percent : Quantiles::kPercents) {
    keys.push_back(prefix + "_perc" + std::to_string(percent));
  }
  append(keys, moments(prefix));
  return keys;
}

/// SPEC sections 2 and 3, in their order.
Keys ordered_keys(std::size_t textures) {
  Keys keys{"mesh",
            "fn",
            "vn",
            "en",
            "en_b",
            "nonmanif_edge",
            "nonmanif_vert",
            "area",
            "boundary_len",
            "area_normalized",
            "boundary_len_normalized",
            "connected_components",
            "boundary_loops",
            "genus",
            "fndup",
            "fnzero",
            "fndegen",
            "vnunref",
            "oriented",
            "orientable",
            "num_charts",
            "num_null_charts",
            "en_uv",
            "en_uv_b",
            "area_uv",
            "boundary_len_uv",
            "mapped_fraction",
            "nfolds",
            "ntex",
            "textures"};
  for (std::size_t i = 0; i < textures; ++i) keys.push_back("texture_" + std::to_string(i));
  append(keys, {"occupancy"});
  append(keys, statistics("qcd"));
  append(keys, {"qcd_discardedArea"});
  append(keys, statistics("sf"));
  append(keys, {"sf_discardedArea"});
  append(keys, moments("seam_discrepancy"));
  append(keys, {"crumbliness", "solidity"});
  append(keys, statistics("conformality"));
  append(keys, {"sf_untrimmed_avg", "sf_untrimmed_var"});
  append(keys, statistics("angle_min"));
  append(keys,
         {"vndup", "euler", "boundary_components", "largest_component_fn", "seam_edges", "seam_len",
          "faces_unmapped", "faces_untextured", "faces_uv_outside", "faces_invalid",
          "faces_nonfinite", "uv_far", "charts_nonorientable", "seam_edges_unsampled",
          "overlap_within_chart_texels", "overlap_between_charts_texels"});
  append(keys, statistics("texel_density"));
  return keys;
}

}  // namespace

void Report::set(const std::string& key, double value) {
  values_[key] = std::isfinite(value) ? Json(value) : Json();
}

const Json& Report::at(const std::string& key) const {
  const auto found = values_.find(key);
  if (found == values_.end()) throw Error(ErrorKind::kInternal, "the report has no key " + key);
  return found->second;
}

// Appends to the object itself: Json's own insertion looks through all keys for an equal one, which
// takes hours for the keys of very many textures.
Json Report::to_json() const {
  const auto ntex = values_.find("ntex");
  const std::size_t textures = ntex == values_.end() ? 0 : ntex->second.get<std::size_t>();
  std::map<std::string, Json> others = values_;
  Json json = {{"schema_version", kSchemaVersion}};
  auto& members = json.get_ref<Json::object_t&>();
  for (const std::string& key : ordered_keys(textures)) {
    auto value = others.extract(key);
    members.push_back({key, value ? std::move(value.mapped()) : Json()});
  }
  for (auto& [key, value] : others) members.push_back({key, std::move(value)});
  return json;
}

}  // namespace atlasgauge
