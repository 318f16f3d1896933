#include "io/texture/texture_slots.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "io/error.hpp"
#include "io/file/file_path.hpp"
#include "io/name_room.hpp"
#include "io/texture/image_files.hpp"
#include "io/texture/mtl_reader.hpp"
#include "io/texture/obj_libraries.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

/// What tells the bytes of an image apart from those of any other.
std::string key_of(const ImageSource& source) {
  if (source.is_whole_file()) return source.path;
  if (source.content == nullptr) {
    return fmt::format("{}#{}+{}", source.path, source.offset, source.byte_size);
  }
  return fmt::format("{}#{}", source.path, static_cast<const void*>(source.content.get()));
}

/// Gathers slots while materials are read in order.
class SlotTable {
 public:
  SlotTable(const std::string& model, std::optional<ImageSize> size_option, const ImageProbe& probe,
            Warnings& warnings)
      : room_(model), size_option_(size_option), probe_(probe), warnings_(warnings) {}

  /// `named_in` is the file that names the image; `missing` says that it is not there, and where it
  /// was sought.
  SlotId slot_of(const NamedImage& image, const std::string& named_in,
                 const std::optional<std::string>& missing) {
    const SlotId next{static_cast<std::uint32_t>(slots_.size())};
    const auto [known, is_new] = slot_at_.try_emplace(key_of(image.source), next);
    if (is_new) {
      room_.add(image.name.size() + 2 * known->first.size());
      slots_.push_back(make_slot(image, named_in, missing));
    }
    return known->second;
  }

  NameRoom& room() { return room_; }
  std::vector<TextureSlot> take_slots() { return std::move(slots_); }

 private:
  TextureSlot make_slot(const NamedImage& image, const std::string& named_in,
                        const std::optional<std::string>& missing) const {
    TextureSlot slot;
    slot.name = image.name;
    slot.source = image.source;
    slot.size = size_option_;
    if (missing) {
      warnings_.add("image missing", named_in, 0, *missing + consequence());
      return slot;
    }
    try {
      const ImageHeader header = probe_(image.source);
      slot.size = header.size;
      slot.readable = true;
      slot.kind = header.kind;
      slot.decoder_bytes = header.decoder_bytes;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      warnings_.add("image unreadable", named_in, 0, error.what() + consequence());
    }
    return slot;
  }

  std::string consequence() const {
    if (!size_option_) return "; its faces are not measured in texels unless -t WxH gives a size";
    return fmt::format("; taken as {}x{} texels", size_option_->width, size_option_->height);
  }

  NameRoom room_;
  std::optional<ImageSize> size_option_;
  const ImageProbe& probe_;
  Warnings& warnings_;
  std::vector<TextureSlot> slots_;
  std::unordered_map<std::string, SlotId> slot_at_;  // by key_of()
};

/// The slots of the materials that one OBJ's libraries define.
class LibraryMaterials {
 public:
  LibraryMaterials(const std::string& obj_path, SlotTable& table, Warnings& warnings)
      : obj_folder_(fs::path(obj_path).parent_path()), table_(table), warnings_(warnings) {}

  void add_library(const std::string& path) {
    for (const Material& material : read_mtl_if_readable(path, warnings_)) {
      const auto [known, is_first] = slot_of_.try_emplace(material.name, kNone<SlotId>);
      if (!is_first) continue;
      table_.room().add(material.name.size());
      if (material.image) known->second = slot_of_image(path, *material.image);
    }
  }

  SlotId slot_of(const std::string& material) const {
    const auto found = slot_of_.find(material);
    return found == slot_of_.end() ? kNone<SlotId> : found->second;
  }

 private:
  SlotId slot_of_image(const fs::path& library, const std::string& name) {
    const ImagePlace place = find_image({library.parent_path(), obj_folder_}, name);
    std::optional<std::string> missing;
    if (!place.exists) {
      missing = fmt::format("image \"{}\" is neither beside this file nor beside the model", name);
    }
    return table_.slot_of({name, {.path = place.path}}, library.string(), missing);
  }

  fs::path obj_folder_;
  SlotTable& table_;
  Warnings& warnings_;
  std::unordered_map<std::string, SlotId> slot_of_;  // by material
};

void add_materials(const std::string& path, const ObjMaterials& obj, SlotTable& table,
                   Warnings& warnings, std::vector<SlotId>& of_material) {
  LibraryMaterials materials(path, table, warnings);
  const ObjLibraries libraries = find_libraries(path, obj.mtllib_lines);
  for (const std::string& name : libraries.missing) {
    warnings.add(
        "library missing", path, 0,
        fmt::format("material library \"{}\" not found; its materials have no images", name));
  }
  for (const std::string& library : libraries.found) materials.add_library(library);
  for (const std::string& name : obj.names) of_material.push_back(materials.slot_of(name));
}

SlotId slot_of(const std::string& path, NamedImage image, SlotTable& table) {
  if (image.source.content != nullptr) return table.slot_of(image, path, std::nullopt);
  std::optional<std::string> missing;
  if (!is_file(image.source.path)) missing = fmt::format("image \"{}\" is not there", image.name);
  image.source.path = one_spelling(image.source.path);
  return table.slot_of(image, path, missing);
}

void add_materials(const std::string& path, const PartMaterials& parts, SlotTable& table, Warnings&,
                   std::vector<SlotId>& of_material) {
  std::vector<SlotId> of_image;
  for (const NamedImage& image : parts.images) of_image.push_back(slot_of(path, image, table));
  for (const std::optional<std::uint32_t>& image : parts.image_of_material) {
    of_material.push_back(image ? of_image[*image] : kNone<SlotId>);
  }
}

/// One slot for all faces of a model whose materials name no image.
TextureSlots virtual_slot(const std::string& model, std::size_t materials,
                          std::optional<ImageSize> size_option, Warnings& warnings) {
  constexpr SlotId kOnly{0};
  if (!size_option) {
    warnings.add("no image", model, 0,
                 "no material names an image, so lengths and areas in the atlas are in UV units "
                 "and texels are not counted; give the size of the texture with -t WxH");
  }
  TextureSlots result;
  result.slots.emplace_back();
  result.slots[0].name = "N/A";
  result.slots[0].size = size_option.value_or(ImageSize{1, 1});
  result.of_material.assign(materials, kOnly);
  result.without_material = kOnly;
  result.unit_slot = !size_option;
  return result;
}

}  // namespace

std::uint64_t TextureSlots::memory_bytes() const {
  std::uint64_t bytes = slots.capacity() * sizeof(TextureSlot);
  for (const TextureSlot& slot : slots) {
    bytes += slot.name.capacity() + slot.source.path.capacity();
    if (slot.source.content != nullptr) bytes += slot.source.content->capacity();
  }
  return bytes + of_material.capacity() * sizeof(SlotId);
}

std::uint64_t InputMaterials::size() const {
  const auto* obj = std::get_if<ObjMaterials>(&materials);
  return obj != nullptr ? obj->names.size()
                        : std::get<PartMaterials>(materials).image_of_material.size();
}

TextureSlots resolve_textures(std::span<const InputMaterials> inputs,
                              std::optional<ImageSize> size_option, const ImageProbe& probe,
                              Warnings& warnings) {
  const std::string& model = inputs.front().path;
  SlotTable table(model, size_option, probe, warnings);
  TextureSlots result;
  for (const InputMaterials& input : inputs) {
    std::visit(
        [&](const auto& materials) {
          add_materials(input.path, materials, table, warnings, result.of_material);
        },
        input.materials);
  }
  result.slots = table.take_slots();
  if (result.slots.empty()) {
    return virtual_slot(model, result.of_material.size(), size_option, warnings);
  }
  result.has_images = true;
  return result;
}

}  // namespace atlasgauge
