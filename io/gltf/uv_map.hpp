#pragma once

#include "io/gltf/gltf_model.hpp"
#include "io/mesh_batch.hpp"

namespace atlasgauge {

/// From the texture coordinates of a glTF, with v = 0 at the top row of the image, to ours. The
/// texture transform is applied in double, and u and v are rounded to float once; then v becomes
/// 1 - v in float, so that a float without a transform meets only this one operation.
class UvMap {
 public:
  explicit UvMap(const UvTransform& transform);

  TexCoord apply(double u, double v) const;

  /// Of the axis that the transform stretches most.
  double coarsest_scale() const;

 private:
  bool is_identity_;
  double uu_, uv_, vu_, vv_;  // from the second letter to the first
  UvTransform transform_;
};

}  // namespace atlasgauge
