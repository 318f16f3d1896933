#pragma once

#include <cstdint>
#include <string>

namespace atlasgauge {

/// A site by the size of its OBJ.
struct SitePlan {
  std::uint64_t faces = 0;
  std::uint64_t obj_bytes = 0;
  std::uint64_t textures = 1;
  std::uint64_t texture_size_texels = 2048;
  std::string texture_format = "jpg";  ///< or png, or none

  /// Model, images, and what a run keeps in scratch: what the disk must hold.
  std::uint64_t disk_bytes() const;
};

/// About what make_site's OBJ takes a face: it grows with the digits of its indices.
double obj_bytes_a_face(double faces);

std::uint64_t faces_of_obj(double obj_bytes);

/// Textures for about eight texels a face, in a number that make_site lays out as a rectangle near
/// to a square.
std::uint64_t textures_for(std::uint64_t faces, std::uint64_t texture_size_texels);

}  // namespace atlasgauge
