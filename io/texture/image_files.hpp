#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/model/image_source.hpp"

namespace atlasgauge {

/// Where an image was found, or would have been.
struct ImagePlace {
  std::string path;
  bool exists;
};

/// All of a file.
NamedImage image_in_file(std::string name, std::string path);

/// In the first folder that has it; a missing image belongs into the first of all.
ImagePlace find_image(const std::vector<std::filesystem::path>& folders, const std::string& name);

/// "model.obj" for "model.obj", "model.obj.gz" and "model.obj.zst".
std::filesystem::path without_compression(std::filesystem::path model_path);

/// The image beside a model that shares its name: "model.png" for "model.ply". Of several, the
/// first of png, jpg, jpeg, tif, tiff, webp, tga, bmp, exr, in small letters or capitals.
std::optional<NamedImage> image_of_stem(const std::filesystem::path& model_path);

/// Where image_of_stem() looks, up to the one that it finds.
std::vector<std::string> places_of_stem_image(const std::filesystem::path& model_path);

}  // namespace atlasgauge
