#include "io/texture/image_reader.hpp"

#include <array>
#include <memory>
#include <string>

#include "io/error.hpp"
#include "io/file/module.hpp"
#include "io/texture/image_module.hpp"

namespace atlasgauge {
namespace {

ImageSizeFunction load_module() {
  return reinterpret_cast<ImageSizeFunction>(module_symbol(kImageModule, kImageSizeSymbol));
}

}  // namespace

ImageHeader read_image_header(const std::string& path) {
  static const ImageSizeFunction image_size = load_module();
  ImageSize size;
  std::array<char, 512> error{};
  if (!image_size(path.c_str(), &size.width, &size.height, error.data(), error.size())) {
    throw Error(ErrorKind::kInput, path, 0, std::string("cannot read the image: ") + error.data());
  }
  return {.size = size};
}

std::unique_ptr<ImageRows> open_image(const std::string& path) {
  throw Error(ErrorKind::kInput, path, 0, "cannot be decoded yet");
}

}  // namespace atlasgauge
