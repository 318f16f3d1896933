#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>

#include "io/texture/image_header.hpp"
#include "stream/seams/seam_path.hpp"
#include "stream/seams/texel_lookup.hpp"

namespace atlasgauge {

/// Red, green and blue, 0 to 255; of floats beyond 0 to 1 beyond that, too.
using Colour = std::array<double, 3>;

inline double distance(const Colour& a, const Colour& b) {
  const double r = a[0] - b[0], g = a[1] - b[1], s = a[2] - b[2];
  return std::sqrt(r * r + g * g + s * s);
}

/// One texel as an image of some kind stores it.
inline Colour colour_of(const std::uint8_t* texel, TexelKind kind) {
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

/// The colours along one side of a seam edge. `Source` has next(), the answers of this side in
/// order.
template <class Source>
class FootprintColours {
 public:
  FootprintColours(Source source, const SeamPath& path, TexelKind kind)
      : source_(std::move(source)), path_(path), kind_(kind) {}

  /// The colour at sample i; to be asked for each i from 0 on.
  Colour at(std::uint64_t i) {
    const Footprint footprint = path_.at(i);
    if (i == 0 || !footprint.has_texels_of(last_)) read_corners();
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

  void read_corners() {
    for (unsigned read = 0; read != 15;) {
      const TexelAnswer& answer = source_.next();
      for (unsigned c = 0; c < 4; ++c) {
        if ((answer.part.corners >> c & 1) == 0) continue;
        const std::size_t at = kind_ == TexelKind::kByte ? c * TexelAnswer::kByteTexels : 0;
        corners_[c] = colour_of(answer.texels + at, kind_);
      }
      read |= answer.part.corners;
    }
  }

  Source source_;
  SeamPath path_;
  TexelKind kind_;
  Footprint last_{};
  std::array<Colour, 4> corners_{};
};

}  // namespace atlasgauge
