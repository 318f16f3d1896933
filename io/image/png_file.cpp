#include "io/image/png_file.hpp"

#include <array>
#include <cstddef>
#include <limits>

#include "io/error.hpp"
#include "io/file/module.hpp"
#include "io/file/output_file.hpp"
#include "io/image/image_module.hpp"

namespace atlasgauge {
namespace {

void append_to(void* text, const void* bytes, std::size_t size) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(bytes), size);
}

bool fills(std::span<const std::uint8_t> rgb, ImageSize size) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::int32_t>::max();
  return size.width > 0 && size.height > 0 && size.width <= kMost && size.height <= kMost &&
         rgb.size() / 3 / size.width == size.height &&
         rgb.size() == std::size_t{size.width} * size.height * 3;
}

}  // namespace

void write_png(const std::string& path, ImageSize size, std::span<const std::uint8_t> rgb) {
  static const auto encode =
      reinterpret_cast<EncodePngFunction>(module_symbol(kImageModule, kEncodePngSymbol));
  std::array<char, 512> error{"the texels do not fill the image"};
  std::string png;
  if (!fills(rgb, size) ||
      !encode(rgb.data(), size.width, size.height, append_to, &png, error.data(), error.size())) {
    throw Error(ErrorKind::kInternal, path, 0,
                std::string("cannot encode the picture: ") + error.data());
  }
  write_file(path, png);
}

}  // namespace atlasgauge
