#pragma once

#include <cstdint>
#include <functional>

#include "io/model/image_source.hpp"

namespace atlasgauge {

/// Width and height in texels.
struct ImageSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// How a component of a decoded texel is kept: as stored in the file, where that is possible.
enum class TexelKind : std::uint8_t {
  kByte,   ///< std::uint8_t, 0 to 255
  kShort,  ///< std::uint16_t, 0 to 65535
  kFloat,  ///< float, nominally 0 to 1; may be anything, NaN too
};

/// Red, green and blue.
constexpr std::uint32_t texel_bytes(TexelKind kind) {
  return kind == TexelKind::kByte ? 3 : kind == TexelKind::kShort ? 6 : 12;
}

/// What the header of an image promises.
struct ImageHeader {
  ImageSize size;
  TexelKind kind = TexelKind::kByte;
  /// Memory that decoding takes besides the rows asked for: little for images that can be decoded
  /// in bands, a multiple of the texels for those that cannot.
  std::uint64_t decoder_bytes = 0;
};

/// Reads the header of an image; throws Error(kInput) if it cannot be read.
using ImageProbe = std::function<ImageHeader(const ImageSource& source)>;

}  // namespace atlasgauge
