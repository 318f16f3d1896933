#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>

#include "io/texture/image_module.hpp"

namespace {

void put_error(const std::string& text, char* error, std::size_t error_bytes) {
  if (error_bytes == 0) return;
  const std::size_t bytes = std::min(text.size(), error_bytes - 1);
  std::memcpy(error, text.data(), bytes);
  error[bytes] = '\0';
}

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
  try {
    const std::string fault = read_size(path, *width, *height);
    if (fault.empty()) return true;
    put_error(fault, error, error_bytes);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    put_error(e.what(), error, error_bytes);
  }
  return false;
}
