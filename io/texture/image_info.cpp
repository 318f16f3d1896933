#include "io/texture/image_info.hpp"

#include <array>
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

ImageSize read_image_size(const std::string& path) {
  static const ImageSizeFunction image_size = load_module();
  ImageSize size;
  std::array<char, 512> error{};
  if (!image_size(path.c_str(), &size.width, &size.height, error.data(), error.size())) {
    throw Error(ErrorKind::kInput, path, 0, std::string("cannot read the image: ") + error.data());
  }
  return size;
}

}  // namespace atlasgauge
