#include "io/gltf/gltf_reader.hpp"

#include <filesystem>

#include "io/error.hpp"

namespace atlasgauge {

GltfReader::GltfReader(const std::string& path, const GltfLimits& limits, Warnings& warnings,
                       const FileListener& files)
    : images_(path, limits.json.memory_bytes),
      content_(whole_file(path), {}, limits, lone_origin(path), images_, files, warnings) {
  require_triangles(content_, path);
}

void require_triangles(const GltfContent& content, const std::string& path) {
  if (!content.is_empty()) return;
  throw Error(ErrorKind::kInput, path, 0,
              "found no triangles: the scene shows no mesh, or points and lines only; give a model "
              "with a surface");
}

GltfOrigin lone_origin(const std::string& path) {
  return {path, std::filesystem::path(path).filename().string(), true};
}

}  // namespace atlasgauge
