#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "io/image/image_module_guard.hpp"

namespace {

constexpr const char* kName = "map.png";  // for the format only

/// Returns the fault, or an empty text.
std::string encode(const std::uint8_t* rgb, std::uint32_t width, std::uint32_t height,
                   std::vector<unsigned char>& png) {
  OIIO::Filesystem::IOVecOutput memory(png);
  const std::unique_ptr<OIIO::ImageOutput> image = OIIO::ImageOutput::create(kName, &memory);
  if (!image) return OIIO::geterror();
  const OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), 3,
                             OIIO::TypeDesc::UINT8);
  const bool written =
      image->open(kName, spec) && image->write_image(OIIO::TypeDesc::UINT8, rgb) && image->close();
  return written ? "" : image->geterror();
}

}  // namespace

extern "C" __attribute__((visibility("default"))) bool atlasgauge_encode_png(
    const std::uint8_t* rgb, std::uint32_t width, std::uint32_t height,
    void (*take)(void* context, const void* png, std::size_t bytes), void* context, char* error,
    std::size_t error_bytes) {
  std::vector<unsigned char> png;
  const bool encoded =
      atlasgauge::tell_fault([&] { return encode(rgb, width, height, png); }, error, error_bytes);
  if (encoded) take(context, png.data(), png.size());
  return encoded;
}
