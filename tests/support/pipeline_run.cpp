#include "tests/support/pipeline_run.hpp"

#include <filesystem>
#include <memory>

#include "io/error.hpp"
#include "measures/base/measure_set.hpp"
#include "stream/pipeline.hpp"
#include "stream/raster/osmesa_raster.hpp"
#include "stream/raster/scalar_raster.hpp"
#include "tests/support/both_rasters.hpp"

namespace atlasgauge {
namespace {

RasterPlan raster_plan(const PipelineConfig& config) {
  RasterPlan plan;
  plan.make = [] { return std::make_unique<ScalarRaster>(); };
  plan.tile_size = config.tile_size;
  if (config.both_rasters) plan.make = [] { return std::make_unique<BothRasters>(); };
  if (config.both_rasters || config.raster == RasterChoice::kScalar) return plan;
  plan.make = make_osmesa_raster;
  plan.largest_tile = kUsualOsmesaTile;
  return plan;
}

constexpr std::size_t kQueuedBlocks = 8;

[[noreturn]] void refuse(const std::string& image) {
  throw Error(ErrorKind::kInput, image, 0, "no images in this test");
}

}  // namespace

PipelineResult run_pipeline(const std::string& model, const PipelineConfig& config) {
  return run_pipeline(std::span(&model, 1), config);
}

PipelineResult run_pipeline(std::span<const std::string> inputs, const PipelineConfig& config) {
  MemoryBudget budget(config.engine_bytes + kQueuedBlocks * config.block_bytes);
  const std::string scratch_dir = std::filesystem::temp_directory_path().string();
  Scratch scratch({scratch_dir, config.block_bytes, config.resident_bytes, kQueuedBlocks}, budget);
  const Workers workers(config.workers);
  StageLog log(scratch, workers);
  const Engine engine{budget, scratch, workers, log};
  Warnings warnings({});
  const ImageProbe probe =
      config.probe ? config.probe
                   : [](const ImageSource& image) -> ImageHeader { refuse(image.path); };
  MeasureSet measures(workers.count());
  const auto resolve = [&](std::span<const InputMaterials> materials) {
    return resolve_textures(materials, config.texture_size, probe, warnings);
  };
  StreamOptions options;
  options.raster = raster_plan(config);
  options.texmetro_seams = config.texmetro_seams;
  options.open_parts = config.open_parts;
  options.open_image = config.open_image;
  if (!config.open_image) {
    options.open_image = [](const ImageSource& image) -> std::unique_ptr<ImageRows> {
      refuse(image.path);
    };
  }
  const MeshFacts facts = stream_model(engine, inputs, options, warnings, resolve, measures);
  return {measures.finish(facts).to_json(), log.stages(), facts.raster,
          budget.peak_bytes() - kQueuedBlocks * config.block_bytes};
}

}  // namespace atlasgauge
