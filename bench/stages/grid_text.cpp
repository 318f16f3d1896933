#include "bench/stages/grid_text.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <iterator>

namespace atlasgauge {

/// UVs are told to six decimals, so whole millionths tell them apart, and their sum is exact.
void ObjTotals::add(const TexCoord& t) {
  ++texcoords;
  uv_numerator +=
      std::round(1e6 * static_cast<double>(t.u)) + std::round(1e6 * static_cast<double>(t.v));
}

void ObjTotals::add(const FaceRecord& face) {
  ++faces;
  for (int k = 0; k < 3; ++k) indices += raw(face.v[k]) + raw(face.t[k]);
}

GridText::GridText(const Grid& grid) {
  auto to = std::back_inserter(text);
  for (std::uint32_t i = 0; i < grid.vertices(); ++i) {
    const Position at = grid.position(i);
    const Position p{at.x / 64, at.y / 64, std::fmod(at.x + at.y, 64) / 64};
    fmt::format_to(to, "v {:.6f} {:.6f} {:.6f}\n", p.x, p.y, p.z);
    totals.add(p);
  }
  for (std::uint32_t i = 0; i < grid.texcoords(); ++i) {
    const TexCoord t = grid.texcoord(i);
    const std::string u = fmt::format("{:.6f}", t.u), v = fmt::format("{:.6f}", t.v);
    fmt::format_to(to, "vt {} {}\n", u, v);
    totals.add(TexCoord{std::strtof(u.c_str(), nullptr), std::strtof(v.c_str(), nullptr)});
  }
  for (std::uint32_t i = 0; i < grid.faces(); ++i) {
    const FaceRecord face = grid.face(i);
    fmt::format_to(to, "f {}/{} {}/{} {}/{}\n", raw(face.v[0]) + 1, raw(face.t[0]) + 1,
                   raw(face.v[1]) + 1, raw(face.t[1]) + 1, raw(face.v[2]) + 1, raw(face.t[2]) + 1);
    totals.add(face);
  }
}

}  // namespace atlasgauge
