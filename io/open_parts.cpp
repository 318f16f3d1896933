#include "io/open_parts.hpp"

#include <array>
#include <cctype>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "io/draco/draco_reader.hpp"
#include "io/file/byte_source.hpp"
#include "io/gltf/gltf_reader.hpp"
#include "io/ply/ply_reader.hpp"
#include "io/suffix.hpp"
#include "io/tiles/b3dm_reader.hpp"
#include "io/tiles/tileset_reader.hpp"

namespace atlasgauge {
namespace {

std::string first_bytes(const std::string& path) {
  std::array<char, 8> bytes{};
  const std::unique_ptr<ByteSource> source = open_byte_source(path);
  std::size_t count = 0;
  while (count < bytes.size()) {
    const std::size_t more = source->read(bytes.data() + count, bytes.size() - count);
    if (more == 0) break;
    count += more;
  }
  return {bytes.data(), count};
}

bool is_ply(std::string_view begin) {
  return begin.starts_with("ply") && begin.size() > 3 &&
         std::isspace(static_cast<unsigned char>(begin[3])) != 0;
}

}  // namespace

std::unique_ptr<PartReader> open_parts(const std::string& path, const PartOptions& options,
                                       Warnings& warnings, const FileListener& files) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return nullptr;
  const GltfLimits limits{.json = {.memory_bytes = options.json_bytes}};
  const std::string begin = first_bytes(path);
  if (begin.starts_with("DRACO") || has_suffix(path, ".drc")) {
    return std::make_unique<DracoReader>(path, warnings, files);
  }
  if (is_ply(begin) || has_suffix(path, ".ply")) {
    return std::make_unique<PlyReader>(path, PlyReader::kBlockBytes, files);
  }
  if (begin.starts_with("b3dm")) return std::make_unique<B3dmReader>(path, limits, warnings, files);
  if (begin.starts_with("glTF") || has_suffix(path, ".gltf") || has_suffix(path, ".glb")) {
    return std::make_unique<GltfReader>(path, limits, warnings, files);
  }
  if (has_suffix(path, ".json")) {
    return std::make_unique<TilesetReader>(path, options.lod, limits, warnings, files);
  }
  return nullptr;
}

}  // namespace atlasgauge
