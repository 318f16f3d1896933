#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "stream/mesh/triangle.hpp"

namespace atlasgauge {

/// The number of samples on a seam edge whose sides have these lengths in texels (SPEC section 5):
/// 5 ceil(longer side - slack).
inline std::uint64_t sample_count(double length_a, double length_b, double slack) {
  return 5 *
         static_cast<std::uint64_t>(std::max(0.0, std::ceil(std::max(length_a, length_b) - slack)));
}

/// What a bilinear lookup reads: the four texels around a point, the one at the lower left being
/// (x, y), v up, and how far between their centres the point lies. Texel centres lie at
/// half-integers.
struct Footprint {
  std::int64_t x, y;
  double fx, fy;

  bool has_texels_of(const Footprint& other) const { return x == other.x && y == other.y; }
};

/// The footprints of the samples t = (i + offset) / n, i < n, on a segment of a texture. The same
/// arithmetic finds the texels and, later, weighs them.
class SeamPath {
 public:
  SeamPath() = default;
  SeamPath(const Texel& from, const Texel& to, std::uint64_t samples, double offset)
      : from_(from),
        step_{to.x - from.x, to.y - from.y},
        samples_(static_cast<double>(samples)),
        offset_(offset) {}

  Footprint at(std::uint64_t i) const {
    const double t = (static_cast<double>(i) + offset_) / samples_;
    const double x = from_.x + step_.x * t - 0.5;
    const double y = from_.y + step_.y * t - 0.5;
    const double low_x = std::floor(x);
    const double low_y = std::floor(y);
    return {static_cast<std::int64_t>(low_x), static_cast<std::int64_t>(low_y), x - low_x,
            y - low_y};
  }

  /// About how many footprints follow each other: one more at every crossing of a column or row.
  double usual_footprints() const {
    return std::min(samples_, 1 + std::abs(step_.x) + std::abs(step_.y));
  }

 private:
  Texel from_{}, step_{};
  double samples_ = 1;
  double offset_ = 0.5;
};

}  // namespace atlasgauge
