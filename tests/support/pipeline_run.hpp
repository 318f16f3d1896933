#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/command_line.hpp"
#include "io/image/image_reader.hpp"
#include "io/texture/texture_slots.hpp"
#include "measures/base/report.hpp"
#include "stream/engine/stage_log.hpp"
#include "stream/mesh/read_model.hpp"
#include "stream/raster/atlas_raster.hpp"

namespace atlasgauge {

/// How to run the pipeline: what a user cannot choose included.
struct PipelineConfig {
  std::uint64_t engine_bytes = std::uint64_t{64} << 20;
  std::uint64_t resident_bytes = 0;
  std::size_t block_bytes = 4096;
  std::size_t workers = 1;
  RasterChoice raster = RasterChoice::kScalar;  ///< OSMesa: after show_modules()
  bool both_rasters = false;                    ///< compared texel by texel; after show_modules()
  std::int64_t tile_size = 0;                   ///< 0: as the memory allows
  std::optional<ImageSize> texture_size;
  ImageProbe probe;      ///< none: no image can be read
  OpenImage open_image;  ///< none: no image can be decoded
  bool texmetro_seams = false;
  OpenParts open_parts = open_no_parts;
};

struct PipelineResult {
  Json report;
  std::vector<StageCost> stages;
  RasterWork raster;
  std::uint64_t peak_reserved_bytes = 0;
};

/// Measures a model in this process.
PipelineResult run_pipeline(const std::string& model, const PipelineConfig& config);
/// The same of several inputs as one model.
PipelineResult run_pipeline(std::span<const std::string> inputs, const PipelineConfig& config);

}  // namespace atlasgauge
