#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/pipeline_run.hpp"
#include "tests/support/random_images.hpp"

namespace atlasgauge {

/// Of images that cannot be decoded.
ImageProbe probe_of(ImageSizes sizes);

/// The report of a model, or the text by which it was refused as bad input.
struct Outcome {
  std::optional<nlohmann::json> report;
  std::string refusal;
  std::uint64_t refused_line = 0;
};

/// What the pipeline makes of a model. Errors of another kind than kInput are passed on.
Outcome pipeline_outcome(const std::string& model, const PipelineConfig& config);

/// What the oracle makes of it, given the same texture size, probe and images.
Outcome oracle_outcome(const std::string& model, const PipelineConfig& config);

/// How far values that are not counts are compared.
enum class Closeness {
  kAllKeys,
  kCounts,  ///< numbers with a fraction are left out
};

/// In words, what the oracle contradicts: a refusal, its line, or a key of the report.
std::vector<std::string> contradictions(const Outcome& pipeline, const Outcome& oracle,
                                        Closeness closeness = Closeness::kAllKeys);

}  // namespace atlasgauge
