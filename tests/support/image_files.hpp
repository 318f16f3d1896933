#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace atlasgauge {

/// Image files, written byte by byte: good ones, and headers that promise what does not follow.

inline std::string little_endian(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 255);
  return text;
}

inline std::string big_endian(std::uint64_t value, int bytes) {
  std::string text = little_endian(value, bytes);
  return {text.rbegin(), text.rend()};
}

using Rgb8 = std::array<std::uint8_t, 3>;

/// colour(column, row), rows from the top.
template <class Colour>
std::string ppm_file(std::uint32_t width, std::uint32_t height, Colour colour) {
  std::string text = "P6\n" + std::to_string(width) + " " + std::to_string(height) + "\n255\n";
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      for (const std::uint8_t component : Rgb8(colour(column, row))) {
        text += static_cast<char>(component);
      }
    }
  }
  return text;
}

inline std::uint32_t crc32(std::string_view bytes) {
  std::uint32_t crc = ~0U;
  for (const char byte : bytes) {
    crc ^= static_cast<std::uint8_t>(byte);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ ((crc & 1) != 0 ? 0xEDB88320U : 0);
  }
  return ~crc;
}

inline std::string png_chunk(const std::string& type, const std::string& data) {
  return big_endian(data.size(), 4) + type + data + big_endian(crc32(type + data), 4);
}

/// 8 bits, red, green and blue; `idat` are the compressed rows.
inline std::string png_file(std::uint32_t width, std::uint32_t height, bool interlaced,
                            const std::string& idat) {
  const std::string header = big_endian(width, 4) + big_endian(height, 4) +
                             std::string("\x08\x02\x00\x00", 4) + (interlaced ? '\1' : '\0');
  return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", idat) +
         png_chunk("IEND", "");
}

/// 8 bits, blue, green and red, from the top; the texels follow.
inline std::string tga_header(std::uint32_t width, std::uint32_t height) {
  return std::string("\0\0\2\0\0\0\0\0\0\0\0\0", 12) + little_endian(width, 2) +
         little_endian(height, 2) + "\x18\x20";
}

/// Run-length encoded and black: nothing but the mark of its end.
inline std::string black_rle_bmp_file(std::uint32_t width, std::uint32_t height) {
  const std::string palette(1024, '\0');
  const std::string texels("\0\1", 2);
  return "BM" + little_endian(54 + palette.size() + texels.size(), 4) + little_endian(0, 4) +
         little_endian(54 + palette.size(), 4) + little_endian(40, 4) + little_endian(width, 4) +
         little_endian(height, 4) + little_endian(1, 2) + little_endian(8, 2) +
         little_endian(1, 4) + little_endian(texels.size(), 4) + little_endian(0, 8) +
         little_endian(256, 4) + little_endian(0, 4) + palette + texels;
}

/// A progressive JPEG that breaks off in its first scan.
inline std::string progressive_jpeg_head(std::uint32_t width, std::uint32_t height) {
  const auto segment = [](const char* marker, const std::string& data) {
    return "\xff" + std::string(marker) + big_endian(data.size() + 2, 2) + data;
  };
  const std::string components("\x03\x01\x11\x00\x02\x11\x00\x03\x11\x00", 10);
  const std::string one_code = std::string("\x00\x01", 2) + std::string(15, '\0') + '\0';
  return "\xff\xd8" + segment("\xdb", '\0' + std::string(64, '\1')) +
         segment("\xc2", "\x08" + big_endian(height, 2) + big_endian(width, 2) + components) +
         segment("\xc4", one_code) +
         segment("\xda", std::string("\x03\x01\x00\x02\x00\x03\x00\x00\x00\x00", 10)) +
         std::string(30, '\0');
}

}  // namespace atlasgauge
