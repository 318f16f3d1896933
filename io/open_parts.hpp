#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "io/file/file_listener.hpp"
#include "io/model/part_reader.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// How to read inputs that come in parts.
struct PartOptions {
  /// Of 3D Tiles: the depth of the tiles to show; none: the leaves.
  std::optional<std::uint32_t> lod;
  std::uint64_t json_bytes = std::uint64_t{64} << 20;  ///< what the JSON of a file may take
};

/// Opens an input by what it is: Draco, PLY (compressed by gzip or zstd, too), glTF, a Batched 3D
/// Model, or a tileset, told by the first bytes; JSON by the name, .gltf or .json. Null for all
/// else, which is taken for an OBJ, and for what is no regular file, as its bytes come only once.
/// `files` hears of all other files that the parts come from, as they are read.
/// Throws Error(kInput).
std::unique_ptr<PartReader> open_parts(const std::string& path, const PartOptions& options,
                                       Warnings& warnings, const FileListener& files = {});

}  // namespace atlasgauge
