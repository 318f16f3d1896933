#pragma once

#include <cstdint>
#include <string>

namespace atlasgauge {

struct DracoCutOptions {
  std::uint64_t chunk_faces = 500'000;  ///< at most, in a file
  int position_bits = 16;
  int uv_bits = 14;
  /// Positions of each chunk are rounded on a grid of its own instead of one for all, so that
  /// chunks come apart at their borders.
  bool own_grids = false;
  bool sequential = false;  ///< instead of Edgebreaker: faster, larger, less memory
};

/// Cuts an OBJ, whose positions and texture coordinates come before its faces, into stretches of
/// faces of one material, and writes each into `directory` as NAME_00000.drc and so on, with a link
/// of the same stem to its image. NAME.obj there, with NAME.mtl, holds what these streams decode
/// to, by the Draco library itself: both must measure the same. Keeps 20 bytes a vertex, and some
/// hundred a face of a chunk. Returns the number of chunks. Throws Error.
std::uint64_t cut_into_draco(const std::string& obj_path, const DracoCutOptions& options,
                             const std::string& directory);

}  // namespace atlasgauge
