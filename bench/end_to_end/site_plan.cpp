#include "bench/end_to_end/site_plan.hpp"

#include <algorithm>
#include <cmath>

namespace atlasgauge {

std::uint64_t SitePlan::disk_bytes() const {
  // Measured: 260 bytes of scratch a face. A texel takes 3 bytes decoded, and at most as many as
  // PNG.
  constexpr std::uint64_t kScratchBytesAFace = 280, kBytesATexel = 6;
  const std::uint64_t texels =
      texture_format == "none" ? 0 : textures * texture_size_texels * texture_size_texels;
  return obj_bytes + faces * kScratchBytesAFace + texels * kBytesATexel;
}

double obj_bytes_a_face(double faces) {
  // Six indices, up to about half the faces; the constant holds from 10 000 to 100 million faces.
  constexpr double kWithoutIndices = 37.8;
  return kWithoutIndices + 6 * std::log10(faces / 2);
}

std::uint64_t faces_of_obj(double obj_bytes) {
  double faces = obj_bytes / 72;
  for (int i = 0; i < 20; ++i) faces = obj_bytes / obj_bytes_a_face(std::max(2.0, faces));
  return static_cast<std::uint64_t>(faces);
}

std::uint64_t textures_for(std::uint64_t faces, std::uint64_t texture_size_texels) {
  constexpr double kTexelsAFace = 8;
  const auto size = static_cast<double>(texture_size_texels);
  const double wanted = std::max(1.0, static_cast<double>(faces) * kTexelsAFace / (size * size));
  const double rows = std::floor(std::sqrt(wanted));
  return static_cast<std::uint64_t>(rows * std::ceil(wanted / rows));
}

}  // namespace atlasgauge
