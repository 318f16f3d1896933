#include "io/texture/obj_libraries.hpp"

#include <algorithm>
#include <filesystem>

#include "io/file/file_path.hpp"
#include "io/texture/image_files.hpp"
#include "io/texture/library_names.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

/// "model.mtl" for "model.obj", "model.obj.gz" and "model.obj.zst".
fs::path own_library(const fs::path& obj_path) {
  return without_compression(obj_path).replace_extension(".mtl");
}

}  // namespace

ObjLibraries find_libraries(const std::string& obj_path,
                            const std::vector<std::string>& mtllib_lines) {
  const fs::path folder = fs::path(obj_path).parent_path();
  const auto exists = [&](const std::string& name) { return is_file(folder / name); };
  ObjLibraries libraries;
  std::vector<std::string>& found = libraries.found;
  if (mtllib_lines.empty() && is_file(own_library(obj_path))) {
    found.push_back(own_library(obj_path).string());
  }
  for (const std::string& line : mtllib_lines) {
    const LibraryNames names = split_library_names(line, exists);
    libraries.missing.insert(libraries.missing.end(), names.missing.begin(), names.missing.end());
    for (const std::string& name : names.found) {
      const std::string path = (folder / name).string();
      if (std::ranges::find(found, path) == found.end()) found.push_back(path);
    }
  }
  return libraries;
}

std::vector<std::string> places_of_missing_libraries(const std::string& obj_path,
                                                     const std::vector<std::string>& mtllib_lines) {
  const fs::path folder = fs::path(obj_path).parent_path();
  const ObjLibraries libraries = find_libraries(obj_path, mtllib_lines);
  std::vector<std::string> places;
  if (mtllib_lines.empty() && libraries.found.empty()) {
    places.push_back(own_library(obj_path).string());
  }
  for (const std::string& text : libraries.missing) {
    for (const std::string& name : possible_library_names(text)) {
      places.push_back((folder / name).string());
    }
  }
  return places;
}

}  // namespace atlasgauge
