#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "io/mesh_batch.hpp"

namespace atlasgauge {

/// An affine map of space, as glTF and 3D Tiles store it: column after column, the images of the
/// three axes and then that of the origin, without the last row (0, 0, 0, 1) of their matrices.
struct Affine {
  std::array<double, 12> m{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0};

  static Affine translation(double x, double y, double z) {
    return {{1, 0, 0, 0, 1, 0, 0, 0, 1, x, y, z}};
  }

  bool operator==(const Affine&) const = default;

  bool is_identity() const { return *this == Affine{}; }

  /// The identity leaves every bit as it is, infinities and -0 too.
  Position apply(const Position& p) const {
    if (is_identity()) return p;
    return {m[0] * p.x + m[3] * p.y + m[6] * p.z + m[9],
            m[1] * p.x + m[4] * p.y + m[7] * p.z + m[10],
            m[2] * p.x + m[5] * p.y + m[8] * p.z + m[11]};
  }

  double determinant() const {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[3] * (m[1] * m[8] - m[2] * m[7]) +
           m[6] * (m[1] * m[5] - m[2] * m[4]);
  }

  /// Length of the longest image of an axis of length 1.
  double coarsest_scale() const {
    double longest = 0;
    for (std::size_t axis = 0; axis < 9; axis += 3) {
      longest = std::max(longest, std::hypot(m[axis], m[axis + 1], m[axis + 2]));
    }
    return longest;
  }
};

/// First `inner`, then `outer`. A factor that is the identity changes nothing.
inline Affine operator*(const Affine& outer, const Affine& inner) {
  if (outer.is_identity()) return inner;
  if (inner.is_identity()) return outer;
  Affine product;
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 3; ++row) {
      double sum = column == 3 ? outer.m[9 + row] : 0;
      for (std::size_t k = 0; k < 3; ++k) sum += outer.m[3 * k + row] * inner.m[3 * column + k];
      product.m[3 * column + row] = sum;
    }
  }
  return product;
}

}  // namespace atlasgauge
