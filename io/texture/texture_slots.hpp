#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "io/ids.hpp"
#include "io/image/image_header.hpp"
#include "io/model/part_reader.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// One image file that the materials name, used by a face or not.
struct TextureSlot {
  std::string name;    ///< as the model spells it, with slashes; "N/A" for the virtual slot
  ImageSource source;  ///< its path is resolved; empty for the virtual slot
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

/// Names that an OBJ gives to its materials and their libraries.
struct ObjMaterials {
  std::vector<std::string> mtllib_lines;  ///< see ObjSummary
  std::vector<std::string> names;         ///< by MaterialId
};

/// The materials of one input; in a model of several their numbers follow each other.
struct InputMaterials {
  std::string path;  ///< of the input
  std::variant<ObjMaterials, PartMaterials> materials;

  std::uint64_t size() const;
};

/// Resolves libraries (relative to the OBJ) and images (to the MTL, then to the OBJ) by SPEC
/// section 1; other inputs name their images themselves. Inputs that name the same image share its
/// slot. Missing libraries and unreadable images are warnings.
TextureSlots resolve_textures(std::span<const InputMaterials> inputs,
                              std::optional<ImageSize> size_option, const ImageProbe& probe,
                              Warnings& warnings);

}  // namespace atlasgauge
