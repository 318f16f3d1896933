#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "io/image/image_header.hpp"

namespace atlasgauge {

/// The header of an image, through OpenImageIO, which is loaded on the first call: it costs 130 MB
/// resident and 0.2 s, so models without images never pay for it.
/// Throws Error(kInput) if the image cannot be read, Error(kInternal) if the module is missing.
ImageHeader read_image_header(const ImageSource& source);

/// The texels of an image, from the top row down: red, green and blue of the header's kind, rows
/// without padding. Colours are as stored: alpha is left away, grey is in all three.
class ImageRows {
 public:
  virtual ~ImageRows() = default;
  virtual const ImageHeader& header() const = 0;
  /// The next rows. Throws Error(kInput) where the file does not hold them, std::bad_alloc.
  virtual void read(std::uint32_t rows, std::byte* to) = 0;
};

/// Opens an image; throws Error(kInput). Different images may be read by different threads.
using OpenImage = std::function<std::unique_ptr<ImageRows>(const ImageSource& source)>;

std::unique_ptr<ImageRows> open_image(const ImageSource& source);

}  // namespace atlasgauge
