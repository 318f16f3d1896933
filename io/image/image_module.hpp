#pragma once

#include <cstddef>
#include <cstdint>

#include "io/file/module.hpp"
#include "io/image/image_header.hpp"

namespace atlasgauge {

inline constexpr const char* kImageModuleFile = "atlasgauge_images.so";

/// The module with the image library, which costs 130 MB resident and 0.2 s once it is loaded. Its
/// functions return false or null on failure, with a text in `error` that ends with '\0', and throw
/// std::bad_alloc, which is no fault of an image.
inline constexpr Module kImageModule{kImageModuleFile, "reads and writes images",
                                     "install the program again"};

/// Reads the header of an image.
using ReadImageHeaderFunction = bool (*)(const char* path, ImageHeader* header, char* error,
                                         std::size_t error_bytes);
inline constexpr const char* kReadImageHeaderSymbol = "atlasgauge_read_image_header";

/// Opens an image for reading and tells its header. One thread at a time may use what it returns.
using OpenImageFunction = void* (*)(const char* path, ImageHeader* header, char* error,
                                    std::size_t error_bytes);
inline constexpr const char* kOpenImageSymbol = "atlasgauge_open_image";

/// Reads the next rows of an open image.
using ReadImageRowsFunction = bool (*)(void* image, std::uint32_t rows, std::byte* to, char* error,
                                       std::size_t error_bytes);
inline constexpr const char* kReadImageRowsSymbol = "atlasgauge_read_image_rows";

using CloseImageFunction = void (*)(void* image);
inline constexpr const char* kCloseImageSymbol = "atlasgauge_close_image";

/// Calls `take` with a PNG file of the texels: red, green and blue, rows from the top down.
using EncodePngFunction = bool (*)(const std::uint8_t* rgb, std::uint32_t width,
                                   std::uint32_t height,
                                   void (*take)(void* context, const void* png, std::size_t bytes),
                                   void* context, char* error, std::size_t error_bytes);
inline constexpr const char* kEncodePngSymbol = "atlasgauge_encode_png";

}  // namespace atlasgauge
