#include "io/tiles/b3dm_reader.hpp"

namespace atlasgauge {

B3dmReader::B3dmReader(const std::string& path, const GltfLimits& limits, Warnings& warnings,
                       const FileListener& files)
    : B3dmReader(path, find_in_b3dm(whole_file(path), limits.json), limits, warnings, files) {}

B3dmReader::B3dmReader(const std::string& path, const TileGltf& tile, const GltfLimits& limits,
                       Warnings& warnings, const FileListener& files)
    : images_(path, limits.json.memory_bytes),
      content_(tile.gltf, {tile.rtc, {}}, limits, lone_origin(path), images_, files, warnings) {
  require_triangles(content_, path);
}

}  // namespace atlasgauge
