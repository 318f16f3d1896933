#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <optional>

#include "measures/base/measure.hpp"
#include "stream/engine/exact_sum.hpp"

namespace atlasgauge {
namespace {

/// The coarsest step of texture coordinates in texels, along the longer side of a texture; NaN
/// where no quantized face has a texture of a size.
double uv_step_texels(const InputQuantization& input, const TextureSlots& textures) {
  double most = std::numeric_limits<double>::quiet_NaN();
  if (textures.unit_slot) return most;
  for (std::size_t i = 0; i < input.uv_steps.size(); ++i) {
    const SlotId slot = textures.of_material[input.first_material + i];
    if (input.uv_steps[i] == 0 || slot == kNone<SlotId>) continue;
    const std::optional<ImageSize>& size = textures.slots[raw(slot)].size;
    if (size) most = std::fmax(most, input.uv_steps[i] * std::max(size->width, size->height));
  }
  return most;
}

Json number_or_null(double value) {
  return std::isfinite(value) ? Json(value) : Json();
}

Json of_input(const InputQuantization& input, const TextureSlots& textures) {
  const bool positions = input.position_bits > 0;
  const bool uvs = input.uv_bits > 0;
  Json json;
  json["input"] = std::filesystem::path(input.path).filename().string();
  json["parts"] = input.parts;
  json["quantized_parts"] = input.quantized_parts;
  json["position_bits"] = positions ? Json(input.position_bits) : Json();
  json["position_step"] = positions ? Json(input.position_step) : Json();
  json["uv_bits"] = uvs ? Json(input.uv_bits) : Json();
  json["uv_step_texels"] = uvs ? number_or_null(uv_step_texels(input, textures)) : Json();
  return json;
}

/// How finely inputs have rounded their values, and where parts of the model came apart by it. The
/// keys are there only where an input is quantized.
struct QuantizationLoss {
  static constexpr std::string_view name = "quantization";

  std::uint64_t cracks = 0;
  ExactSum cracks_length;  // model units

  void accumulate(const CrackEdge& edge) {
    ++cracks;
    cracks_length.add(edge.length_3d);
  }

  void merge(const QuantizationLoss& other) {
    cracks += other.cracks;
    cracks_length.merge(other.cracks_length);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(cracks, cracks_length);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    if (facts.quantizations.empty()) return;
    Json inputs = Json::array();
    for (const InputQuantization& input : facts.quantizations) {
      inputs.push_back(of_input(input, facts.textures));
    }
    report.set("quantization", std::move(inputs));
    report.set("cracks", cracks);
    report.set("cracks_len", cracks_length.value());
  }
};

const Registered<QuantizationLoss> registered;

}  // namespace
}  // namespace atlasgauge
