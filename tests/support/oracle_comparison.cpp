#include "tests/support/oracle_comparison.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <system_error>

#include "io/error.hpp"
#include "tests/support/agreement.hpp"
#include "tests/support/oracle/oracle.hpp"

namespace atlasgauge {
namespace {

using nlohmann::json;

/// What agreement of values takes when one of them is 0.
double absolute_tolerance(const std::string& key, const json& all) {
  if (key.starts_with("conformality") && !key.ends_with("_var")) return kConformality;
  const double own = key.starts_with("seam_discrepancy") ? kDiscrepancy : 0;
  const std::string rms = key.substr(0, key.find_last_of('_')) + "_rms";
  const double scale = all.contains(rms) && all.at(rms).is_number() ? all.at(rms).get<double>() : 1;
  const double deviation = std::max(own, kDeviation * scale);
  if (key.ends_with("_stddev")) return deviation;
  if (key.ends_with("_var")) return deviation * deviation;
  return own;
}

bool key_agrees(const std::string& key, const json& got, const json& all_of_oracle) {
  const json& want = all_of_oracle.at(key);
  if (key == "worst_seams") return worst_seams_agree(got, want);
  return agree(got, want, absolute_tolerance(key, all_of_oracle));
}

oracle::Colour colour_of(TexelKind kind, const std::byte* texel) {
  oracle::Colour colour{};
  for (std::size_t i = 0; i < colour.size(); ++i) {
    switch (kind) {
      case TexelKind::kByte:
        colour[i] = std::to_integer<int>(texel[i]);
        break;
      case TexelKind::kShort: {
        std::uint16_t value = 0;
        std::memcpy(&value, texel + i * sizeof value, sizeof value);
        colour[i] = value * 255.0 / 65535;
        break;
      }
      case TexelKind::kFloat: {
        float value = 0;
        std::memcpy(&value, texel + i * sizeof value, sizeof value);
        colour[i] = value * 255.0;
        break;
      }
    }
  }
  return colour;
}

/// All of an image, for the oracle; none if it cannot be decoded.
oracle::Pixels decode(const OpenImage& open, const std::string& path) {
  if (!open) return {};
  try {
    const std::unique_ptr<ImageRows> image = open({.path = path});
    const ImageHeader header = image->header();
    const std::size_t texel_size = texel_bytes(header.kind), width = header.size.width;
    std::vector<std::byte> bytes(texel_size * width * header.size.height);
    image->read(header.size.height, bytes.data());
    const auto kept = std::make_shared<const std::vector<std::byte>>(std::move(bytes));
    return [=](std::int64_t column, std::int64_t row) {
      const auto texel = static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column);
      return colour_of(header.kind, kept->data() + texel * texel_size);
    };
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    return {};
  }
}

oracle::Options oracle_options(const PipelineConfig& config) {
  oracle::Options options;
  if (const auto size = config.texture_size) {
    options.size_option = oracle::Size{size->width, size->height};
  }
  options.texmetro_seams = config.texmetro_seams;
  options.image_pixels = [open = config.open_image](const std::string& path) {
    return decode(open, path);
  };
  options.image_size = [probe = config.probe](const std::string& path) {
    std::optional<oracle::Size> size;
    std::error_code ignored;
    if (!probe || !std::filesystem::is_regular_file(path, ignored)) return size;
    try {
      const ImageSize found = probe({.path = path}).size;
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
  return [sizes = std::move(sizes)](const ImageSource& image) {
    const std::string& path = image.path;
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
    if (closeness == Closeness::kCounts && want.is_number_float()) continue;
    const json got = pipeline.report->value(key, json("missing"));
    if (key_agrees(key, got, *oracle.report)) continue;
    texts.push_back(key + " is " + got.dump() + ", the oracle has " + want.dump());
  }
  return texts;
}

}  // namespace atlasgauge
