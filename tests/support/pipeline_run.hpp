#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/texture/texture_slots.hpp"
#include "measures/base/report.hpp"
#include "stream/engine/stage_log.hpp"

namespace atlasgauge {

/// How to run the pipeline: what a user cannot choose included.
struct PipelineConfig {
  std::uint64_t engine_bytes = std::uint64_t{64} << 20;
  std::uint64_t resident_bytes = 0;
  std::size_t block_bytes = 4096;
  std::size_t workers = 1;
  std::optional<ImageSize> texture_size;
  ImageProbe probe;  ///< none: no image can be read
};

struct PipelineResult {
  Json report;
  std::vector<StageCost> stages;
  std::uint64_t peak_reserved_bytes = 0;
};

/// Measures a model in this process.
PipelineResult run_pipeline(const std::string& model, const PipelineConfig& config);

}  // namespace atlasgauge
