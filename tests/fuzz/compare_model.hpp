#pragma once

#include <string>

#include "tests/fuzz/fuzz.hpp"
#include "tests/support/oracle_comparison.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge::fuzz {

/// A folder with images of known sizes, for one model after the other.
class ModelFolder {
 public:
  explicit ModelFolder(const ImageSizes& images) : probe_(probe_of(images)) {
    for (const auto& image : images) dir_.write(image.first, "");
  }

  void write_materials(const std::string& mtl) const { dir_.write("model.mtl", mtl); }

  /// Pipeline and oracle agree on the model, be it on its report or on the line where it is broken.
  void compare(const std::string& obj, PipelineConfig config, Closeness closeness) const {
    const std::string path = dir_.write("model.obj", obj);
    config.probe = probe_;
    const Outcome oracle = oracle_outcome(path, config);
    const Outcome pipeline = pipeline_outcome(path, config);
    std::string text;
    for (const std::string& line : contradictions(pipeline, oracle, closeness)) text += line + "\n";
    if (!text.empty()) std::fprintf(stderr, "The model:\n%s\n", obj.c_str());
    require(text.empty(), text);
  }

 private:
  TempDir dir_;
  ImageProbe probe_;
};

/// Engines so small that every stage spills, up to those where all stays in memory.
inline PipelineConfig draw_config(FuzzedDataProvider& input) {
  PipelineConfig config;
  config.workers = input.ConsumeIntegralInRange<std::size_t>(1, 3);
  config.block_bytes = input.PickValueInArray<std::size_t>({4096, 8192});
  config.engine_bytes = input.PickValueInArray<std::uint64_t>({1 << 20, 2 << 20, 8 << 20});
  config.resident_bytes = input.PickValueInArray<std::uint64_t>({0, 1 << 16, 1 << 18});
  if (input.ConsumeBool()) config.texture_size = ImageSize{40, 30};
  return config;
}

}  // namespace atlasgauge::fuzz
