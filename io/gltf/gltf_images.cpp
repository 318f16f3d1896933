#include "io/gltf/gltf_images.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>

#include "io/error.hpp"
#include "io/file/file_path.hpp"
#include "io/file/uri.hpp"

namespace atlasgauge {
namespace {

constexpr const char* kUnreadableKind = "image unreadable";

std::string with_slashes(std::string name) {
  std::ranges::replace(name, '\\', '/');
  return name;
}

void check_indices(const GltfModel& model, const std::string& path) {
  for (const GltfMaterial& material : model.materials) {
    if (!material.colour || material.colour->texture < model.textures.size()) continue;
    throw Error(ErrorKind::kInput, path, 0,
                fmt::format("a material names texture {}, but there are {}",
                            material.colour->texture, model.textures.size()));
  }
  for (const GltfTexture& texture : model.textures) {
    if (!texture.image || *texture.image < model.images.size()) continue;
    throw Error(ErrorKind::kInput, path, 0,
                fmt::format("a texture names image {}, but there are {}", *texture.image,
                            model.images.size()));
  }
}

/// The text of an error without the path that a warning begins with anyway.
std::string without_path(const std::string& what, const std::string& path) {
  return what.starts_with(path + ": ") ? what.substr(path.size() + 2) : what;
}

/// What no image library takes for an image.
ImageSource no_bytes(const std::string& path) {
  return {path, 0, 0, std::make_shared<const std::string>()};
}

bool begins_as_ktx2(const ImageSource& source) {
  constexpr std::string_view kMagic = "\xABKTX 20\xBB";
  if (source.content != nullptr) return source.content->starts_with(kMagic);
  if (source.is_whole_file()) return false;
  return read_begin({source.path, source.offset, source.byte_size, nullptr}, kMagic.size()) ==
         kMagic;
}

}  // namespace

/// One glTF being added.
class GltfImages::Adding {
 public:
  Adding(GltfImages& images, const GltfModel& model, GltfBuffers& buffers, const GltfOrigin& origin,
         Warnings& warnings)
      : images_(images), model_(model), buffers_(buffers), origin_(origin), warnings_(warnings) {
    for (const GltfImage& image : model.images) ++uses_of_name_[image.name];
  }

  std::optional<std::uint32_t> image_of(const GltfMaterial& material) {
    if (!material.colour) return std::nullopt;
    const GltfTexture& texture = model_.textures[material.colour->texture];
    if (!texture.image) return std::nullopt;
    return image(*texture.image, texture.is_basis);
  }

 private:
  std::uint32_t image(std::uint32_t number, bool is_basis) {
    const std::string place = place_of(number);
    const auto next = static_cast<std::uint32_t>(images_.materials_.images.size());
    const auto [known, is_new] = images_.image_at_.try_emplace(place, next);
    if (!is_new) return known->second;
    NamedImage named{free_name(number), source_of(number)};
    images_.room_.add(named.name.size() + named.source.path.size() + place.size());
    warn_of_basis(number, named, is_basis);
    images_.materials_.images.push_back(std::move(named));
    return next;
  }

  /// What tells images apart: the file, or which image of which glTF.
  std::string place_of(std::uint32_t number) const {
    const GltfImage& image = model_.images[number];
    if (!image.uri.text.empty()) {
      const auto file = file_of_uri(image.uri.text, buffers_.folder());
      if (file) return one_spelling(*file);
    }
    if (image.view && *image.view < model_.views.size()) {
      const GltfBufferView& view = model_.views[*image.view];
      return fmt::format("{}#{}:{}:{}", origin_.key, view.buffer, view.byte_offset,
                         view.byte_length);
    }
    return fmt::format("{}#image{}", origin_.key, number);
  }

  ImageSource source_of(std::uint32_t number) {
    const GltfImage& image = model_.images[number];
    if (image.uri.content != nullptr) return source_in_document(image);
    if (!image.uri.text.empty()) return source_in_file(number);
    if (image.view) return source_in_view(number);
    warn(fmt::format("image {} names neither a file nor a buffer view", number));
    return no_bytes(buffers_.path());
  }

  ImageSource source_in_document(const GltfImage& image) {
    const std::uint64_t bytes = image.uri.content->size();
    if (bytes > images_.data_bytes_left_) {
      throw Error(ErrorKind::kResource, buffers_.path(), 0,
                  "its images in data: URIs take more memory than there is room for; allow more "
                  "memory, or move the images to files of their own");
    }
    images_.data_bytes_left_ -= bytes;
    return {buffers_.path(), 0, 0, image.uri.content};
  }

  ImageSource source_in_file(std::uint32_t number) {
    const std::string& uri = model_.images[number].uri.text;
    const auto file = file_of_uri(uri, buffers_.folder());
    if (file) return {one_spelling(*file), 0, 0, nullptr};
    warn(fmt::format("image {} is at \"{}\", which is no file; fetch it, and name the copy", number,
                     shown_uri(uri)));
    return no_bytes(buffers_.path());
  }

  ImageSource source_in_view(std::uint32_t number) {
    try {
      const ByteRange bytes =
          buffers_.view(*model_.images[number].view, fmt::format("image {}", number));
      if (bytes.size == 0) return no_bytes(buffers_.path());
      if (bytes.content == nullptr) return {bytes.path, bytes.offset, bytes.size, nullptr};
      return {bytes.path, 0, 0,
              std::make_shared<const std::string>(*bytes.content, bytes.offset, bytes.size)};
    } catch (const Error& error) {
      if (error.kind() != ErrorKind::kInput) throw;
      warn(without_path(error.what(), buffers_.path()));
      return no_bytes(buffers_.path());
    }
  }

  std::string name_of(std::uint32_t number) const {
    const GltfImage& image = model_.images[number];
    if (!image.uri.text.empty()) return with_slashes(percent_decoded(image.uri.text));
    const bool tells_apart = !image.name.empty() && uses_of_name_.at(image.name) == 1;
    if (tells_apart && origin_.is_alone) return image.name;
    if (tells_apart) return fmt::format("{}#{}", origin_.label, image.name);
    return fmt::format("{}#image{}", origin_.label, number);
  }

  std::string free_name(std::uint32_t number) {
    std::string name = name_of(number);
    if (images_.names_.insert(name).second) return name;
    std::string numbered = fmt::format("{}#{}", origin_.label, name);
    for (std::uint32_t copy = 2; !images_.names_.insert(numbered).second; ++copy) {
      numbered = fmt::format("{}#{} ({})", origin_.label, name, copy);
    }
    return numbered;
  }

  void warn_of_basis(std::uint32_t number, const NamedImage& named, bool is_basis) {
    const bool is_ktx2 = is_basis || model_.images[number].is_basis || begins_as_ktx2(named.source);
    if (!is_ktx2) return;
    warn(
        fmt::format("image \"{}\" is KTX2/Basis (KHR_texture_basisu), which is not read here, and "
                    "the model has no other in its place; its geometry is measured. Convert the "
                    "images to JPEG, PNG or WebP",
                    named.name));
  }

  void warn(const std::string& text) { warnings_.add(kUnreadableKind, buffers_.path(), 0, text); }

  GltfImages& images_;
  const GltfModel& model_;
  GltfBuffers& buffers_;
  const GltfOrigin& origin_;
  Warnings& warnings_;
  std::unordered_map<std::string, std::uint32_t> uses_of_name_;
};

GltfImages::GltfImages(std::string path, std::uint64_t most_data_bytes)
    : path_(std::move(path)), data_bytes_left_(most_data_bytes), room_(path_) {}

std::uint32_t GltfImages::add(const GltfModel& model, GltfBuffers& buffers,
                              const GltfOrigin& origin, Warnings& warnings) {
  check_indices(model, buffers.path());
  Adding adding(*this, model, buffers, origin, warnings);
  const auto first = static_cast<std::uint32_t>(materials_.image_of_material.size());
  for (const GltfMaterial& material : model.materials) {
    room_.add(0);
    materials_.image_of_material.push_back(adding.image_of(material));
  }
  return first;
}

}  // namespace atlasgauge
