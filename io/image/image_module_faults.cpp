#include "io/image/image_module_faults.hpp"

#include <cstdint>
#include <stdexcept>

#include "io/image/image_module_bytes.hpp"

namespace atlasgauge {
namespace {

/// Run lengths of four or eight bits, and nothing else.
bool is_faulty_bmp(HeaderBytes& file) {
  if (file.text(2) != "BM") return false;
  file.seek(28);
  const std::uint32_t bits = file.little_endian(2);
  const std::uint32_t compression = file.little_endian(4);
  return (compression == 1 && bits != 8) || (compression == 2 && bits != 4);
}

/// One or two bytes a channel.
bool is_faulty_sgi(HeaderBytes& file) {
  if (file.big_endian(2) != 0x01da) return false;
  file.byte();  // compression
  const std::uint8_t bytes = file.byte();
  return bytes != 1 && bytes != 2;
}

/// Fewer channels than the colours take.
bool is_faulty_psd(HeaderBytes& file) {
  constexpr std::uint32_t kRgb = 3;
  constexpr std::uint32_t kCmyk = 4;
  constexpr std::uint32_t kLab = 9;
  if (file.text(4) != "8BPS") return false;
  file.seek(12);
  const std::uint32_t channels = file.big_endian(2);
  file.seek(24);
  const std::uint32_t colours = file.big_endian(2);
  return ((colours == kRgb || colours == kLab) && channels < 3) ||
         (colours == kCmyk && channels < 4) || channels == 0;
}

/// A palette with fewer colours than its indices can name. Targa has no magic number.
bool is_faulty_targa(HeaderBytes& file) {
  file.byte();  // length of a comment
  const std::uint8_t has_palette = file.byte();
  const std::uint8_t type = file.byte();
  if (has_palette != 1 || (type != 1 && type != 9)) return false;
  const std::uint32_t first = file.little_endian(2);
  const std::uint32_t colours = file.little_endian(2);
  file.seek(16);
  const std::uint8_t bits = file.byte();
  return first != 0 || bits > 16 || colours < (1U << bits);
}

}  // namespace

void check_header_faults(const std::string& path) {
  for (const auto is_faulty : {is_faulty_bmp, is_faulty_sgi, is_faulty_psd, is_faulty_targa}) {
    HeaderBytes file(path);
    if (is_faulty(file) && !file.ended()) {
      throw std::runtime_error("its header contradicts itself or is not supported");
    }
  }
}

}  // namespace atlasgauge
