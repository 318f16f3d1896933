#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/model/part_reader.hpp"
#include "io/texture/texture_slots.hpp"
#include "io/warnings.hpp"
#include "stream/engine/engine.hpp"
#include "stream/mesh/mesh_store.hpp"

namespace atlasgauge {

/// Opens an input that comes in parts; null for an OBJ. Throws Error(kInput).
using OpenParts =
    std::function<std::unique_ptr<PartReader>(const std::string& path, Warnings& warnings)>;

/// Knows no inputs but OBJ.
inline std::unique_ptr<PartReader> open_no_parts(const std::string&, Warnings&) {
  return nullptr;
}

/// What an input with quantized parts says of them. Material numbers are those of the model.
struct InputQuantization {
  std::string path;
  std::uint64_t parts = 0;            ///< of the input
  std::uint64_t quantized_parts = 0;  ///< of these
  std::uint32_t position_bits = 0;    ///< the fewest of a part; 0: none quantizes positions
  double position_step = 0;           ///< the largest, in model units
  std::uint32_t uv_bits = 0;          ///< likewise
  std::vector<double> uv_steps;       ///< by material from `first_material` on, in UV units
  std::uint64_t first_material = 0;
};

/// A model, read.
struct ReadModel {
  MeshStore mesh;
  std::vector<InputMaterials> materials;         ///< by input
  std::vector<InputQuantization> quantizations;  ///< of inputs with quantized parts
};

/// Reads inputs, one after the other, into scratch as one model: an OBJ is parsed on all workers,
/// and of other inputs as many parts are loaded at once as there are workers and memory for.
/// Polygons that name no vertex of their part are gone from the faces.
ReadModel read_model(const Engine& engine, std::span<const std::string> inputs,
                     const OpenParts& open_parts, Warnings& warnings);

}  // namespace atlasgauge
