#include <OpenImageIO/imageio.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "io/texture/image_module_guard.hpp"

namespace {

std::string library_error() {
  const std::string text = OIIO::geterror();
  return text.empty() ? "the file is no image of a known format" : text;
}

/// Returns the fault, or an empty text.
std::string read_size(const char* path, std::uint32_t& width, std::uint32_t& height) {
  const std::unique_ptr<OIIO::ImageInput> image = OIIO::ImageInput::open(path);
  if (!image) return library_error();
  const OIIO::ImageSpec& spec = image->spec();
  if (spec.width <= 0 || spec.height <= 0) return "the header names an image without texels";
  width = static_cast<std::uint32_t>(spec.width);
  height = static_cast<std::uint32_t>(spec.height);
  return {};
}

}  // namespace

extern "C" __attribute__((visibility("default"))) bool atlasgauge_image_size(
    const char* path, std::uint32_t* width, std::uint32_t* height, char* error,
    std::size_t error_bytes) {
  return atlasgauge::tell_fault([&] { return read_size(path, *width, *height); }, error,
                                error_bytes);
}
