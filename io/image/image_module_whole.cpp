#include "io/image/image_module_whole.hpp"

#include <cctype>
#include <cstdint>

#include "io/image/image_module_bytes.hpp"
#include "io/image/image_module_jpeg.hpp"

namespace atlasgauge {
namespace {

std::uint64_t texels(ImageSize size) {
  return std::uint64_t{size.width} * size.height;
}

/// Red, green, blue and alpha of the canvas.
std::optional<ImageHeader> header_of_gif(HeaderBytes& file) {
  file.seek(0);
  const std::string magic = file.text(6);
  if (magic != "GIF87a" && magic != "GIF89a") return std::nullopt;
  ImageSize size;
  size.width = file.little_endian(2);
  size.height = file.little_endian(2);
  return ImageHeader{.size = size, .kind = TexelKind::kByte, .decoder_bytes = 4 * texels(size)};
}

/// The indices of run-length encoded texels and their colours.
std::optional<ImageHeader> header_of_run_length_bmp(HeaderBytes& file) {
  file.seek(0);
  if (file.text(2) != "BM") return std::nullopt;
  ImageSize size;
  file.seek(18);
  size.width = file.little_endian(4);
  size.height = file.little_endian(4);
  file.seek(30);
  const std::uint32_t compression = file.little_endian(4);
  const bool run_lengths = compression == 1 || compression == 2;
  if (!run_lengths || size.width > INT32_MAX || size.height > INT32_MAX) return std::nullopt;
  return ImageHeader{.size = size, .kind = TexelKind::kByte, .decoder_bytes = texels(size)};
}

ImageSize webp_size(HeaderBytes& file, const std::string& chunk) {
  if (chunk == "VP8X") {
    file.seek(24);
    const std::uint32_t width = file.little_endian(3) + 1;
    return {width, file.little_endian(3) + 1};
  }
  if (chunk == "VP8L") {
    file.seek(21);
    const std::uint32_t bits = file.little_endian(4);
    return {(bits & 0x3fff) + 1, (bits >> 14 & 0x3fff) + 1};
  }
  file.seek(26);
  const std::uint32_t width = file.little_endian(2) & 0x3fff;
  return {width, file.little_endian(2) & 0x3fff};
}

/// The file and the texels as composed; without loss they are decoded apart.
std::optional<ImageHeader> header_of_webp(HeaderBytes& file) {
  file.seek(0);
  const std::string magic = file.text(16);
  if (magic.compare(0, 4, "RIFF") != 0 || magic.compare(8, 4, "WEBP") != 0) return std::nullopt;
  const std::string chunk = magic.substr(12);
  const ImageSize size = webp_size(file, chunk);
  const std::uint64_t texel_bytes = chunk == "VP8 " ? 4 : 12;
  return ImageHeader{.size = size,
                     .kind = TexelKind::kByte,
                     .decoder_bytes = file.file_bytes() + texel_bytes * texels(size)};
}

/// A number of a Netpbm header, with blanks and comments before it.
std::uint32_t netpbm_number(HeaderBytes& file) {
  std::uint8_t next = file.byte();
  while (!file.ended() && (std::isspace(next) != 0 || next == '#')) {
    while (!file.ended() && next == '#') {
      while (!file.ended() && next != '\n') next = file.byte();
    }
    next = file.byte();
  }
  std::uint64_t number = 0;
  for (; !file.ended() && std::isdigit(next) != 0; next = file.byte()) {
    number = number * 10 + (next - std::uint64_t{'0'});
    if (number > UINT32_MAX) return 0;
  }
  return static_cast<std::uint32_t>(number);
}

TexelKind netpbm_kind(HeaderBytes& file, char type) {
  if (type == 'F' || type == 'f') return TexelKind::kFloat;
  if (type == '1' || type == '4') return TexelKind::kByte;
  return netpbm_number(file) > 255 ? TexelKind::kShort : TexelKind::kByte;
}

/// The file.
std::optional<ImageHeader> header_of_netpbm(HeaderBytes& file) {
  file.seek(0);
  const std::string magic = file.text(2);
  if (magic[0] != 'P' || std::string("123456Ff").find(magic[1]) == std::string::npos) {
    return std::nullopt;
  }
  ImageHeader header;
  header.size.width = netpbm_number(file);
  header.size.height = netpbm_number(file);
  header.kind = netpbm_kind(file, magic[1]);
  if (file.ended()) return std::nullopt;
  header.decoder_bytes = file.file_bytes();
  return header;
}

}  // namespace

std::optional<ImageHeader> header_of_image_held_whole(const std::string& path) {
  for (const auto header_of : {header_of_jpeg_of_many_scans, header_of_gif, header_of_webp,
                               header_of_netpbm, header_of_run_length_bmp}) {
    HeaderBytes file(path);
    const std::optional<ImageHeader> header = header_of(file);
    if (header && !file.ended() && texels(header->size) > 0) return header;
  }
  return std::nullopt;
}

}  // namespace atlasgauge
