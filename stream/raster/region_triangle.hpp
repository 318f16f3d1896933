#pragma once

#include <cstdint>

#include "io/mesh_batch.hpp"

namespace atlasgauge {

/// A copy of a triangle on its way to one of the regions that it may touch. It carries its UVs, as
/// every level snaps them for itself.
class RegionTriangle {
 public:
  RegionTriangle() = default;
  RegionTriangle(std::uint32_t region, std::uint32_t chart, bool is_first, const TexCoord (&uv)[3])
      : region_(region), bits_(chart | (is_first ? kFirst : 0)), uv_{uv[0], uv[1], uv[2]} {}

  std::uint32_t key() const { return region_; }
  std::uint32_t chart() const { return bits_ & ~kFirst; }
  /// Of all copies of the triangle, the one to be drawn where it is to be drawn once.
  bool is_first() const { return (bits_ & kFirst) != 0; }
  const TexCoord (&uv() const)[3] { return uv_; }

 private:
  static constexpr std::uint32_t kFirst = std::uint32_t{1} << 31;

  std::uint32_t region_ = 0;
  std::uint32_t bits_ = 0;
  TexCoord uv_[3]{};
};
static_assert(sizeof(RegionTriangle) == 32);

}  // namespace atlasgauge
