#pragma once

#include <cstddef>
#include <cstdint>

namespace atlasgauge {

/// What the module with the image library exports, under the name kImageSizeSymbol. Reads the
/// header of an image; on failure returns false and puts a text that ends with '\0' into `error`.
/// Throws std::bad_alloc, which is no fault of the image.
using ImageSizeFunction = bool (*)(const char* path, std::uint32_t* width, std::uint32_t* height,
                                   char* error, std::size_t error_bytes);

inline constexpr const char* kImageModuleFile = "atlasgauge_images.so";
inline constexpr const char* kImageSizeSymbol = "atlasgauge_image_size";

}  // namespace atlasgauge
