#include "io/gltf/uv_map.hpp"

#include <algorithm>
#include <cmath>

namespace atlasgauge {

/// KHR_texture_transform: translation after rotation after scale. Counter-clockwise as the image
/// shows, where v runs down.
UvMap::UvMap(const UvTransform& transform)
    : is_identity_(transform == UvTransform{}),
      uu_(std::cos(transform.rotation) * transform.scale[0]),
      uv_(std::sin(transform.rotation) * transform.scale[1]),
      vu_(-std::sin(transform.rotation) * transform.scale[0]),
      vv_(std::cos(transform.rotation) * transform.scale[1]),
      transform_(transform) {}

TexCoord UvMap::apply(double u, double v) const {
  if (!is_identity_) {
    const double moved_u = uu_ * u + uv_ * v + transform_.offset[0];
    const double moved_v = vu_ * u + vv_ * v + transform_.offset[1];
    u = moved_u;
    v = moved_v;
  }
  // -0 becomes +0.
  return {static_cast<float>(u) + 0.0F, 1.0F - static_cast<float>(v)};
}

double UvMap::coarsest_scale() const {
  return std::max(std::abs(transform_.scale[0]), std::abs(transform_.scale[1]));
}

}  // namespace atlasgauge
