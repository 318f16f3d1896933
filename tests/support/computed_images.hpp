#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "io/image/image_reader.hpp"

namespace atlasgauge {

/// An image without a file behind it.
struct ComputedImage {
  ImageSize size;
  TexelKind kind = TexelKind::kByte;
  /// Of a texel, rows counted from the top. From 0 to 255, for floats beyond that, too.
  std::function<std::array<double, 3>(std::uint32_t column, std::uint32_t row)> colour;
  std::optional<std::uint32_t> broken_row = std::nullopt;  ///< cannot be read
};

/// By file name.
class ComputedImages {
 public:
  explicit ComputedImages(std::map<std::string, ComputedImage> images);

  ImageProbe probe() const;
  OpenImage open() const;

 private:
  std::map<std::string, ComputedImage> images_;
};

}  // namespace atlasgauge
