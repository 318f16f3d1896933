#include "tests/support/pipeline_run.hpp"

#include <filesystem>

#include "io/error.hpp"
#include "measures/base/measure_set.hpp"
#include "stream/pipeline.hpp"

namespace atlasgauge {

PipelineResult run_pipeline(const std::string& model, const PipelineConfig& config) {
  MemoryBudget budget(config.engine_bytes);
  const std::string scratch_dir = std::filesystem::temp_directory_path().string();
  Scratch scratch({scratch_dir, config.block_bytes, config.resident_bytes}, budget);
  const Workers workers(config.workers);
  StageLog log(scratch, workers);
  const Engine engine{budget, scratch, workers, log};
  Warnings warnings({});
  const ImageProbe probe = config.probe ? config.probe : [](const std::string& path) -> ImageSize {
    throw Error(ErrorKind::kInput, path, 0, "no images in this test");
  };
  MeasureSet measures(workers.count());
  const auto resolve = [&](const ObjSummary& obj) {
    return resolve_textures(model, obj.mtllib_lines, obj.material_names, config.texture_size, probe,
                            warnings);
  };
  const MeshFacts facts = stream_model(engine, model, warnings, resolve, measures);
  return {measures.finish(facts).to_json(), log.stages(), budget.peak_bytes()};
}

}  // namespace atlasgauge
