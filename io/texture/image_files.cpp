#include "io/texture/image_files.hpp"

#include <array>
#include <cctype>
#include <utility>

#include "io/file/file_path.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

constexpr std::array kStemSuffixes = {".png",  ".jpg", ".jpeg", ".tif", ".tiff",
                                      ".webp", ".tga", ".bmp",  ".exr"};

std::string in_capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

}  // namespace

NamedImage image_in_file(std::string name, std::string path) {
  return {std::move(name), {.path = std::move(path), .content = nullptr}};
}

ImagePlace find_image(const std::vector<fs::path>& folders, const std::string& name) {
  for (const fs::path& folder : folders) {
    if (is_file(folder / name)) return {one_spelling(folder / name), true};
  }
  return {one_spelling(folders.front() / name), false};
}

fs::path without_compression(fs::path model_path) {
  const fs::path extension = model_path.extension();
  if (extension == ".gz" || extension == ".zst") model_path.replace_extension();
  return model_path;
}

std::vector<std::string> places_of_stem_image(const fs::path& model_path) {
  std::vector<std::string> places;
  fs::path path = without_compression(model_path);
  for (const char* const suffix : kStemSuffixes) {
    for (const std::string& spelling : {std::string(suffix), in_capitals(suffix)}) {
      places.push_back(path.replace_extension(spelling).string());
      if (is_file(path)) return places;
    }
  }
  return places;
}

std::optional<NamedImage> image_of_stem(const fs::path& model_path) {
  const fs::path last = places_of_stem_image(model_path).back();
  if (!is_file(last)) return std::nullopt;
  return image_in_file(last.filename().string(), one_spelling(last));
}

}  // namespace atlasgauge
