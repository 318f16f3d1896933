#include "tests/support/oracle_comparison.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "io/error.hpp"
#include "tests/support/oracle/oracle.hpp"
#include "tests/support/pending_keys.hpp"

namespace atlasgauge {
namespace {

using nlohmann::json;

/// Values that divide rounded sums, or take singular values in double, agree to this.
constexpr double kRelative = 1e-11;
/// Conformality of a sliver, between 0 and 1, is what rounding left of its area.
constexpr double kConformality = 1e-14;
/// The deviation of values that are all but equal is the rounding of the values, against their rms.
constexpr double kDeviation = 1e-13;

double absolute_tolerance(const std::string& key, const json& all) {
  if (key.starts_with("conformality") && !key.ends_with("_var")) return kConformality;
  const std::string rms = key.substr(0, key.find_last_of('_')) + "_rms";
  const double scale = all.contains(rms) && all.at(rms).is_number() ? all.at(rms).get<double>() : 1;
  if (key.ends_with("_stddev")) return kDeviation * scale;
  if (key.ends_with("_var")) return kDeviation * scale * kDeviation * scale;
  return 0;
}

bool agree(const json& got, const json& want, double absolute) {
  if (!got.is_number_float() && !want.is_number_float()) return got == want;
  if (!got.is_number() || !want.is_number()) return false;
  const double a = got.get<double>(), b = want.get<double>();
  return std::abs(a - b) <= std::max(absolute, kRelative * std::max(std::abs(a), std::abs(b)));
}

oracle::Options oracle_options(const PipelineConfig& config) {
  oracle::Options options;
  if (const auto size = config.texture_size) {
    options.size_option = oracle::Size{size->width, size->height};
  }
  options.image_size = [probe = config.probe](const std::string& path) {
    std::optional<oracle::Size> size;
    std::error_code ignored;
    if (!probe || !std::filesystem::is_regular_file(path, ignored)) return size;
    try {
      const ImageSize found = probe(path).size;
      size = {found.width, found.height};
    } catch (const Error&) {
    }
    return size;
  };
  return options;
}

/// The number behind a text; 0 if the text does not occur or no number follows.
std::uint64_t number_after(std::string_view message, std::string_view text) {
  const std::size_t at = message.find(text);
  std::uint64_t number = 0;
  if (at == std::string_view::npos) return 0;
  std::from_chars(message.data() + at + text.size(), message.data() + message.size(), number);
  return number;
}

}  // namespace

ImageProbe probe_of(ImageSizes sizes) {
  return [sizes = std::move(sizes)](const std::string& path) {
    const auto found = sizes.find(std::filesystem::path(path).filename().string());
    if (found == sizes.end()) throw Error(ErrorKind::kInput, path, 0, "missing");
    return ImageHeader{.size = {found->second.first, found->second.second}};
  };
}

Outcome pipeline_outcome(const std::string& model, const PipelineConfig& config) {
  try {
    return {run_pipeline(model, config).report, {}, 0};
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return {std::nullopt, error.what(), number_after(error.what(), model + ":")};
  }
}

Outcome oracle_outcome(const std::string& model, const PipelineConfig& config) {
  try {
    return {oracle::measure_obj(model, oracle_options(config)), {}, 0};
  } catch (const std::runtime_error& error) {
    return {std::nullopt, error.what(), number_after(error.what(), "line ")};
  }
}

std::vector<std::string> contradictions(const Outcome& pipeline, const Outcome& oracle,
                                        Closeness closeness) {
  if (pipeline.report.has_value() != oracle.report.has_value() ||
      pipeline.refused_line != oracle.refused_line) {
    return {"the pipeline says '" + pipeline.refusal + "', the oracle '" + oracle.refusal + "'"};
  }
  if (!oracle.report) return {};
  std::vector<std::string> texts;
  for (const auto& [key, want] : oracle.report->items()) {
    if (is_pending(key)) continue;
    if (closeness == Closeness::kCounts && want.is_number_float()) continue;
    const json got = pipeline.report->value(key, json("missing"));
    if (agree(got, want, absolute_tolerance(key, *oracle.report))) continue;
    texts.push_back(key + " is " + got.dump() + ", the oracle has " + want.dump());
  }
  return texts;
}

}  // namespace atlasgauge
