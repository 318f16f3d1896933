#pragma once

#include "stream/mesh/triangle.hpp"

namespace atlasgauge {

/// Whether a face has area in 3D and in UV, so that the map between the two has a scale and a
/// shape.
inline bool is_mapped(const Triangle& triangle) {
  return triangle.at_welded_level() && triangle.area_3d > 0 && triangle.area_uv != 0;
}

/// Quasi-conformal distortion of a mapped face: the ratio s_max / s_min >= 1 of the singular values
/// of the Jacobian from its 3D plane to texels. 1 = conformal.
double quasi_conformal_distortion(const Triangle& triangle);

}  // namespace atlasgauge
