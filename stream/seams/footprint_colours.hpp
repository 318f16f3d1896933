#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <utility>

#include "io/image/image_header.hpp"
#include "stream/seams/seam_path.hpp"
#include "stream/seams/seam_rule.hpp"

namespace atlasgauge {

/// Red, green and blue, 0 to 255; of floats beyond 0 to 1 beyond that, too.
using Colour = std::array<double, 3>;

inline double distance(const Colour& a, const Colour& b) {
  const double r = a[0] - b[0], g = a[1] - b[1], s = a[2] - b[2];
  return std::sqrt(r * r + g * g + s * s);
}

/// One texel as an image of some kind stores it.
inline Colour colour_of(const void* stored, TexelKind kind) {
  const auto* texel = static_cast<const std::uint8_t*>(stored);
  if (kind == TexelKind::kByte) {
    return {static_cast<double>(texel[0]), static_cast<double>(texel[1]),
            static_cast<double>(texel[2])};
  }
  Colour colour;
  for (std::size_t i = 0; i < 3; ++i) {
    if (kind == TexelKind::kShort) {
      std::uint16_t value = 0;
      std::memcpy(&value, texel + i * sizeof(value), sizeof(value));
      colour[i] = value / 257.0;  // 65535 is 255
    } else {
      float value = 0;
      std::memcpy(&value, texel + i * sizeof(value), sizeof(value));
      colour[i] = value * 255.0;
    }
  }
  return colour;
}

/// The colours at the corners of a footprint: corner c is the texel at (x + c % 2, y + c / 2).
using CornerColours = std::array<Colour, 4>;

/// The colours along one side of a seam edge. `Source` has read(footprint, corners), which is
/// called for one footprint after the other.
template <class Source>
class FootprintColours {
 public:
  FootprintColours(Source source, const SeamPath& path) : source_(std::move(source)), path_(path) {}

  /// The colour at sample i; to be asked for each i from 0 on.
  Colour at(std::uint64_t i) {
    const Footprint footprint = path_.at(i);
    if (i == 0 || !footprint.has_texels_of(last_)) source_.read(footprint, corners_);
    last_ = footprint;
    Colour colour;
    for (std::size_t k = 0; k < 3; ++k) {
      const double low = mix(corners_[0][k], corners_[1][k], footprint.fx);
      const double high = mix(corners_[2][k], corners_[3][k], footprint.fx);
      colour[k] = mix(low, high, footprint.fy);
    }
    return colour;
  }

 private:
  static double mix(double a, double b, double t) { return a * (1 - t) + b * t; }

  Source source_;
  SeamPath path_;
  Footprint last_{};
  CornerColours corners_{};
};

/// The mean distance of the colours on the two sides of an edge, the distances added in the order
/// of the samples; NaN where there is none. `source(side)` is that of a side.
template <class Sources>
double mean_distance(const SeamSamples& samples, Sources source) {
  if (samples.count == 0) return std::numeric_limits<double>::quiet_NaN();
  FootprintColours a(source(0), samples.sides[0]);
  FootprintColours b(source(1), samples.sides[1]);
  double sum = 0;
  for (std::uint64_t i = 0; i < samples.count; ++i) sum += distance(a.at(i), b.at(i));
  return sum / static_cast<double>(samples.count);
}

}  // namespace atlasgauge
