#pragma once

#include <optional>

#include "io/file/byte_range.hpp"

namespace atlasgauge {

/// Where the two halves of a glTF lie.
struct GltfChunks {
  ByteRange json;
  std::optional<ByteRange> binary;  ///< the BIN chunk of a GLB
};

/// Tells GLB (glTF 2.0, section 4.4: binary, by its magic) from JSON text. Throws Error(kInput) for
/// a GLB that is cut off, or of another version.
GltfChunks find_gltf_chunks(const ByteRange& range);

}  // namespace atlasgauge
