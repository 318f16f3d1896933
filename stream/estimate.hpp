#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/texture/texture_slots.hpp"
#include "stream/memory_plan.hpp"
#include "stream/mesh/read_model.hpp"

namespace atlasgauge {

/// What a model seems to hold, from a sample of its text.
struct ModelGuess {
  double positions = 0;
  double texcoords = 0;
  double faces = 0;
  double text_bytes = 0;
  /// Bytes of vertex tables that a cache loads for a face: tens where the file is written region by
  /// region, tens of thousands where faces name vertices in random order.
  double loaded_bytes_per_face = 0;
  std::uint64_t images = 0;        ///< that materials name and that can be read
  double texels = 0;               ///< of all of them
  double largest_side_texels = 0;  ///< of any
  double decoded_bytes = 0;        ///< of all of them in scratch
  double decoding_bytes = 0;       ///< memory for the one that takes most
  bool is_whole = false;           ///< counted, not sampled
  bool is_reliable = true;  ///< false for a compressed model of which only the beginning was seen
};

/// What a run will cost, by the sizes of the records that its stages keep. Made to be within a
/// factor of 1.5 of what the run then uses where the guess is reliable and the faces are in random
/// order. Where faces are near each other, it is an upper bound, up to twice what is used: whether
/// they are does not show in a sample.
struct CostEstimate {
  std::uint64_t scratch_bytes = 0;       ///< alive at once, in memory and on disk
  std::uint64_t scratch_file_bytes = 0;  ///< of these, on disk
  std::uint64_t resident_bytes = 0;      ///< peak of the process
  double cpu_seconds = 0;                ///< on a machine of 2020 or so
  double wall_seconds = 0;
};

/// What a guess may ask of the inputs.
struct GuessSources {
  ImageProbe probe;
  OpenParts open_parts = open_no_parts;
};

/// Reads at most 64 MiB of each OBJ's text, the headers of the parts of other inputs, material
/// libraries, and the headers of images.
ModelGuess guess_model(std::span<const std::string> inputs, const GuessSources& sources);

CostEstimate estimate_cost(const ModelGuess& guess, const MemoryPlan& plan);

/// Throws Error(kResource) when even the least that the estimate allows is more than there is:
/// free space for scratch in `directory`, or memory in the plan; the text names what would do.
void require_resources(const ModelGuess& guess, const CostEstimate& cost, const MemoryPlan& plan,
                       const std::string& directory);

/// The same before a run, at no cost where the sizes of OBJ files alone show that all is well.
void require_resources_for(std::span<const std::string> inputs, const MemoryPlan& plan,
                           const std::string& directory, const GuessSources& sources);

}  // namespace atlasgauge
