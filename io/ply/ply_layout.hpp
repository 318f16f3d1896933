#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/ply/ply_header.hpp"

namespace atlasgauge {

/// Which properties of a PLY file say what, and the materials that its faces may have.
struct PlyLayout {
  /// Places of x, y, z, and of u, v where vertices have texture coordinates, by property.
  enum Role : std::uint8_t { kX, kY, kZ, kU, kV, kNoRole };
  std::vector<Role> vertex_roles;
  bool vertices_have_uv = false;  ///< and faces have none of their own

  std::uint64_t vertices = 0;
  std::uint64_t polygons = 0;
  std::optional<std::size_t> face_indices;   ///< among the properties of `face`
  std::optional<std::size_t> face_texcoord;  ///< pairs, a corner each
  std::optional<std::size_t> face_texnumber;
  std::optional<std::size_t> strip_indices;  ///< among the properties of `tristrips`

  /// Of `texnumber`; 0 where the file names none.
  std::size_t textures = 0;
  /// Whether the one image of a file that names none is that of all faces.
  bool has_own_image = false;
};

/// Throws Error(kInput) for a file without what makes a mesh, Error(kResource) for one with too
/// many vertices.
PlyLayout lay_out_ply(const PlyHeader& header, const std::string& path);

}  // namespace atlasgauge
