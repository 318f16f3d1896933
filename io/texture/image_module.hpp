#pragma once

#include <cstddef>
#include <cstdint>

#include "io/file/module.hpp"

namespace atlasgauge {

inline constexpr const char* kImageModuleFile = "atlasgauge_images.so";

/// The module with the image library, which costs 130 MB resident and 0.2 s once it is loaded. Its
/// functions return false on failure, with a text in `error` that ends with '\0', and throw
/// std::bad_alloc, which is no fault of an image.
inline constexpr Module kImageModule{kImageModuleFile, "reads and writes images",
                                     "install the program again"};

/// Reads the header of an image.
using ImageSizeFunction = bool (*)(const char* path, std::uint32_t* width, std::uint32_t* height,
                                   char* error, std::size_t error_bytes);
inline constexpr const char* kImageSizeSymbol = "atlasgauge_image_size";

/// Calls `take` with a PNG file of the texels: red, green and blue, rows from the top down.
using EncodePngFunction = bool (*)(const std::uint8_t* rgb, std::uint32_t width,
                                   std::uint32_t height,
                                   void (*take)(void* context, const void* png, std::size_t bytes),
                                   void* context, char* error, std::size_t error_bytes);
inline constexpr const char* kEncodePngSymbol = "atlasgauge_encode_png";

}  // namespace atlasgauge
