#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/ids.hpp"
#include "io/image/image_header.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// One image file that the materials name, used by a face or not.
struct TextureSlot {
  std::string name;  ///< as spelled in the MTL, with slashes; "N/A" for the virtual slot
  std::string path;  ///< resolved; empty for the virtual slot
  std::optional<ImageSize> size;      ///< from the image's header, else from `-t`, else none
  bool readable = false;              ///< the image's header could be read
  TexelKind kind = TexelKind::kByte;  ///< of a readable image
  std::uint64_t decoder_bytes = 0;    ///< see ImageHeader
};

/// The slots of a model, and the slot of every material that faces use.
struct TextureSlots {
  std::vector<TextureSlot> slots;
  std::vector<SlotId> of_material;          ///< by MaterialId; kNone = names no image
  SlotId without_material = kNone<SlotId>;  ///< for faces before any `usemtl`
  bool has_images = false;                  ///< some material names an image, readable or not
  bool unit_slot = false;                   ///< the virtual slot, 1x1 for lack of `-t`

  std::uint64_t memory_bytes() const;
};

/// Resolves libraries (relative to the OBJ) and images (to the MTL, then to the OBJ) by SPEC
/// section 1. Missing libraries and unreadable images are warnings.
TextureSlots resolve_textures(const std::string& obj_path,
                              const std::vector<std::string>& mtllib_lines,
                              const std::vector<std::string>& material_names,
                              std::optional<ImageSize> size_option, const ImageProbe& probe,
                              Warnings& warnings);

}  // namespace atlasgauge
