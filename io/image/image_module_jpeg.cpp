#include "io/image/image_module_jpeg.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace atlasgauge {
namespace {

constexpr std::uint8_t kStartOfImage = 0xd8;
constexpr std::uint8_t kEndOfImage = 0xd9;
constexpr std::uint8_t kStartOfScan = 0xda;

/// Samples of a component in each block of texels, across and down.
struct Sampling {
  std::uint32_t across = 1;
  std::uint32_t down = 1;
};

struct Frame {
  bool progressive = false;
  ImageSize size;
  std::vector<Sampling> components;
};

std::uint8_t next_marker(HeaderBytes& file) {
  while (!file.ended() && file.byte() != 0xff) {
  }
  std::uint8_t marker = 0xff;
  while (!file.ended() && marker == 0xff) marker = file.byte();
  return marker;
}

bool stands_alone(std::uint8_t marker) {
  return marker <= 0x01 || (marker & 0xf8) == 0xd0;
}

/// SOF0 to SOF15, among which DHT, JPG and DAC have a place.
bool starts_frame(std::uint8_t marker) {
  return (marker & 0xf0) == 0xc0 && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
}

Frame read_frame(HeaderBytes& file, std::uint8_t marker) {
  Frame frame;
  frame.progressive = (marker & 0x03) == 2;
  file.byte();  // bits of a sample
  frame.size.height = file.big_endian(2);
  frame.size.width = file.big_endian(2);
  frame.components.resize(file.byte());
  for (Sampling& sampling : frame.components) {
    file.byte();  // name
    const std::uint8_t factors = file.byte();
    sampling = {.across = std::uint32_t{factors} >> 4, .down = factors & 0x0fU};
    file.byte();  // quantization table
  }
  return frame;
}

std::uint64_t blocks(std::uint32_t texels, std::uint32_t samples, std::uint32_t most_samples) {
  const std::uint64_t block_texels = std::uint64_t{8} * most_samples;
  return (texels + block_texels - 1) / block_texels * samples;
}

/// Two bytes a coefficient, 64 a block; edges are filled up to whole blocks of all components.
std::uint64_t coefficient_bytes(const Frame& frame) {
  Sampling most;
  for (const Sampling& component : frame.components) {
    most.across = std::max(most.across, component.across);
    most.down = std::max(most.down, component.down);
  }
  std::uint64_t bytes = 0;
  for (const Sampling& component : frame.components) {
    bytes += blocks(frame.size.width, component.across, most.across) *
             blocks(frame.size.height, component.down, most.down) * 128;
  }
  return bytes;
}

}  // namespace

std::optional<ImageHeader> header_of_jpeg_of_many_scans(HeaderBytes& file) {
  file.seek(0);
  if (file.byte() != 0xff || file.byte() != kStartOfImage) return std::nullopt;
  Frame frame;
  while (true) {
    const std::uint8_t marker = next_marker(file);
    if (file.ended() || marker == kEndOfImage) return std::nullopt;
    if (stands_alone(marker)) continue;
    const std::uint64_t start = file.offset();
    const std::uint32_t bytes = file.big_endian(2);
    if (marker == kStartOfScan) break;
    if (starts_frame(marker)) frame = read_frame(file, marker);
    file.seek(start + bytes);
  }
  const std::uint8_t components_in_scan = file.byte();
  const bool one_scan = !frame.progressive && components_in_scan >= frame.components.size();
  if (file.ended() || one_scan || frame.size.width == 0 || frame.size.height == 0) {
    return std::nullopt;
  }
  return ImageHeader{
      .size = frame.size, .kind = TexelKind::kByte, .decoder_bytes = coefficient_bytes(frame)};
}

}  // namespace atlasgauge
