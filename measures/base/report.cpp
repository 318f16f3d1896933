#include "measures/base/report.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "io/json/json_text.hpp"
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

/// SPEC sections 2 and 3, in their order, up to the textures.
Keys keys_before_textures() {
  return {"mesh",
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
}

Keys keys_after_textures() {
  Keys keys{"occupancy"};
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
  append(keys, statistics("chart_area"));
  append(keys, {"thin_charts_fraction", "thin_charts_area_fraction", "seam_discrepancy_by_texture",
                "worst_seams"});
  return keys;
}

bool contains(const Keys& keys, const std::string& key) {
  return std::find(keys.begin(), keys.end(), key) != keys.end();
}

/// A value that ends a line, its own lines one step further in. Texts hold no line ends of their
/// own.
std::string indented(const Json& value) {
  std::string text;
  for (const char c : json_text(value, 1)) {
    text += c;
    if (c == '\n') text += ' ';
  }
  return text;
}

/// An array, an element a line.
std::string element_lines(const Json& array) {
  std::string text;
  for (const Json& element : array) {
    text += (text.empty() ? "[\n  " : ",\n  ") + json_text(element);
  }
  return text.empty() ? "[]" : text + "\n ]";
}

bool is_table(const Json& value) {
  return value.is_array() && !value.empty() && value.front().is_object();
}

}  // namespace

void Report::set(const std::string& key, double value) {
  values_[key] = std::isfinite(value) ? Json(value) : Json();
}

void Report::set_textures(std::uint64_t count, Textures textures) {
  texture_count_ = count;
  textures_ = std::move(textures);
}

Json Report::value_of(const std::string& key) const {
  const auto found = values_.find(key);
  return found == values_.end() ? Json() : found->second;
}

Json Report::at(const std::string& key) const {
  if (!values_.contains(key) && !contains(keys_before_textures(), key) &&
      !contains(keys_after_textures(), key)) {
    throw Error(ErrorKind::kInternal, "the report has no key " + key);
  }
  return value_of(key);
}

void Report::visit(const std::function<void(const std::string&, const Json&)>& use) const {
  std::set<std::string> others;
  for (const auto& [key, value] : values_) others.insert(key);
  const auto use_keys = [&](const Keys& keys) {
    for (const std::string& key : keys) {
      use(key, value_of(key));
      others.erase(key);
    }
  };
  use("schema_version", kSchemaVersion);
  use_keys(keys_before_textures());
  const std::function<Json()> next = textures_ ? textures_() : nullptr;
  for (std::uint64_t i = 0; i < texture_count_; ++i) use("texture_" + std::to_string(i), next());
  use_keys(keys_after_textures());
  for (const std::string& key : others) use(key, value_of(key));
}

void Report::write(const std::function<void(std::string_view)>& put) const {
  std::string line = "{\n ";
  visit([&](const std::string& key, const Json& value) {
    line += json_text(Json(key)) + ": ";
    line += is_table(value) ? element_lines(value) : indented(value);
    put(line);
    line = ",\n ";
  });
  put("\n}\n");
}

// Appends to the object itself: Json's own insertion looks through all keys for an equal one.
Json Report::to_json() const {
  Json json = Json::object();
  auto& members = json.get_ref<Json::object_t&>();
  visit([&](const std::string& key, const Json& value) { members.push_back({key, value}); });
  return json;
}

}  // namespace atlasgauge
