#include "io/texture/texture_slots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "io/error.hpp"
#include "io/name_room.hpp"
#include "io/texture/image_files.hpp"
#include "io/texture/library_names.hpp"
#include "io/texture/mtl_reader.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

/// Gathers slots while libraries are read in order.
class SlotTable {
 public:
  SlotTable(const std::string& obj_path, std::optional<ImageSize> size_option,
            const ImageProbe& probe, Warnings& warnings)
      : obj_folder_(fs::path(obj_path).parent_path()),
        room_(obj_path),
        size_option_(size_option),
        probe_(probe),
        warnings_(warnings) {}

  void add_library(const std::string& path) {
    for (const Material& material : read_library(path)) {
      const auto [known, is_first] = slot_of_.try_emplace(material.name, kNone<SlotId>);
      if (!is_first) continue;
      room_.add(material.name.size());
      if (material.image) known->second = slot_of_image(path, *material.image);
    }
  }

  SlotId slot_of(const std::string& material) const {
    const auto found = slot_of_.find(material);
    return found == slot_of_.end() ? kNone<SlotId> : found->second;
  }

  std::vector<TextureSlot> take_slots() { return std::move(slots_); }

 private:
  std::vector<Material> read_library(const std::string& path) const {
    try {
      return read_mtl(path, warnings_);
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      warnings_.add("library unreadable", path, 0, error.what());
      return {};
    }
  }

  SlotId slot_of_image(const fs::path& library, const std::string& name) {
    const ImagePlace place = find_image({library.parent_path(), obj_folder_}, name);
    const SlotId next{static_cast<std::uint32_t>(slots_.size())};
    const auto [known, is_new] = slot_at_.try_emplace(place.path, next);
    if (is_new) {
      room_.add(name.size() + 2 * place.path.size());
      slots_.push_back(make_slot(name, place, library));
    }
    return known->second;
  }

  TextureSlot make_slot(const std::string& name, const ImagePlace& place,
                        const fs::path& library) const {
    TextureSlot slot;
    slot.name = name;
    slot.path = place.path;
    slot.size = size_option_;
    if (!place.exists) {
      warnings_.add("image missing", library.string(), 0,
                    fmt::format("image \"{}\" is neither beside this file nor beside the model{}",
                                name, consequence()));
      return slot;
    }
    try {
      const ImageHeader header = probe_(place.path);
      slot.size = header.size;
      slot.readable = true;
      slot.kind = header.kind;
      slot.decoder_bytes = header.decoder_bytes;
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      warnings_.add("image unreadable", library.string(), 0, error.what() + consequence());
    }
    return slot;
  }

  std::string consequence() const {
    if (!size_option_) return "; its faces are not measured in texels unless -t WxH gives a size";
    return fmt::format("; taken as {}x{} texels", size_option_->width, size_option_->height);
  }

  fs::path obj_folder_;
  NameRoom room_;
  std::optional<ImageSize> size_option_;
  const ImageProbe& probe_;
  Warnings& warnings_;
  std::vector<TextureSlot> slots_;
  std::unordered_map<std::string, SlotId> slot_of_;  // by material
  std::unordered_map<std::string, SlotId> slot_at_;  // by path
};

/// "model.mtl" for "model.obj", compressed or not.
fs::path own_library(const fs::path& obj_path) {
  return without_compression(obj_path).replace_extension(".mtl");
}

/// Paths of the libraries that exist, each once.
std::vector<std::string> find_libraries(const std::string& obj_path,
                                        const std::vector<std::string>& mtllib_lines,
                                        Warnings& warnings) {
  const fs::path folder = fs::path(obj_path).parent_path();
  const auto exists = [&](const std::string& name) { return is_file(folder / name); };
  std::vector<std::string> libraries;
  if (mtllib_lines.empty() && is_file(own_library(obj_path))) {
    libraries.push_back(own_library(obj_path).string());
  }
  for (const std::string& line : mtllib_lines) {
    const LibraryNames names = split_library_names(line, exists);
    for (const std::string& name : names.missing) {
      warnings.add(
          "library missing", obj_path, 0,
          fmt::format("material library \"{}\" not found; its materials have no images", name));
    }
    for (const std::string& name : names.found) {
      const std::string path = (folder / name).string();
      if (std::ranges::find(libraries, path) == libraries.end()) libraries.push_back(path);
    }
  }
  return libraries;
}

/// One slot for all faces of a model whose materials name no image.
TextureSlots virtual_slot(const std::string& obj_path, std::size_t materials,
                          std::optional<ImageSize> size_option, Warnings& warnings) {
  constexpr SlotId kOnly{0};
  if (!size_option) {
    warnings.add("no image", obj_path, 0,
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
  for (const TextureSlot& slot : slots) bytes += slot.name.capacity() + slot.path.capacity();
  return bytes + of_material.capacity() * sizeof(SlotId);
}

TextureSlots resolve_textures(const std::string& obj_path,
                              const std::vector<std::string>& mtllib_lines,
                              const std::vector<std::string>& material_names,
                              std::optional<ImageSize> size_option, const ImageProbe& probe,
                              Warnings& warnings) {
  SlotTable table(obj_path, size_option, probe, warnings);
  for (const std::string& library : find_libraries(obj_path, mtllib_lines, warnings)) {
    table.add_library(library);
  }

  TextureSlots result;
  result.slots = table.take_slots();
  if (result.slots.empty()) {
    return virtual_slot(obj_path, material_names.size(), size_option, warnings);
  }
  result.has_images = true;
  for (const std::string& name : material_names) result.of_material.push_back(table.slot_of(name));
  return result;
}

}  // namespace atlasgauge
