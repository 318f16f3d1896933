#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/image/image_reader.hpp"
#include "io/texture/texture_slots.hpp"
#include "io/warnings.hpp"
#include "stream/engine/engine.hpp"
#include "stream/seams/texel_store.hpp"

namespace atlasgauge {

/// How to decode images.
struct DecodePlan {
  std::string model;  ///< path, for warnings
  OpenImage open_image = atlasgauge::open_image;
  /// Memory within the limit of the process that the engine leaves unused.
  std::uint64_t spare_bytes = 0;
};

/// What the image of a slot takes.
struct ImageNeed {
  std::uint64_t scratch_bytes = 0;  ///< decoded
  std::uint64_t memory_bytes = 0;   ///< while it is decoded, whoever allocates it
};

/// Of a readable slot.
ImageNeed image_need(const TextureSlot& slot, std::size_t block_bytes);

/// Throws Error(kResource), naming image and need, if an image that a material of the faces names
/// cannot be decoded in the memory there is, or if there is no room in scratch for all of them:
/// before the work of a run, and before anything of a size that a header claims is allocated.
void require_room_for_images(const Engine& engine, const TextureSlots& textures,
                             const DecodePlan& plan);

/// Decodes the images of the wanted slots, each once and in bands, into tiles in scratch. Several
/// at a time where memory allows, else one after the other. An image that cannot be decoded is a
/// warning and stays undecoded.
TexelStore decode_images(const Engine& engine, const TextureSlots& textures,
                         const std::vector<bool>& wanted, const DecodePlan& plan,
                         Warnings& warnings);

}  // namespace atlasgauge
