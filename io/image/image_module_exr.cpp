#include "io/image/image_module_exr.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

#include "io/image/image_module_bytes.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint32_t kMagic = 20000630;
constexpr std::uint32_t kMultiPart = 0x1000;
constexpr std::size_t kMostNameBytes = 255;

/// Rows that are compressed together, by the number of the compression.
constexpr std::array<std::uint64_t, 10> kBlockRows = {1, 1, 1, 16, 32, 16, 32, 32, 32, 256};

struct Part {
  std::uint64_t width = 0;
  std::uint64_t height = 0;
  std::uint64_t block_rows = 256;
  std::uint64_t tile_width = 0;  ///< 0: not in tiles
  std::uint64_t tile_height = 0;
};

[[noreturn]] void fail(const char* text) {
  throw std::runtime_error(text);
}

std::uint64_t extent(std::uint32_t least, std::uint32_t most) {
  const auto last = static_cast<std::int32_t>(most);
  const auto first = static_cast<std::int32_t>(least);
  return last < first ? 0 : static_cast<std::uint64_t>(std::int64_t{last} - first + 1);
}

void read_data_window(HeaderBytes& file, Part& part) {
  std::array<std::uint32_t, 4> box{};
  for (std::uint32_t& side : box) side = file.little_endian(4);
  part.width = extent(box[0], box[2]);
  part.height = extent(box[1], box[3]);
}

/// False at the end of the header of the part.
bool read_attribute(HeaderBytes& file, std::uint64_t file_bytes, Part& part) {
  const std::string name = file.text_to_zero(kMostNameBytes);
  if (name.empty()) return false;
  file.text_to_zero(kMostNameBytes);  // type
  const std::uint32_t bytes = file.little_endian(4);
  if (file.ended()) return false;
  const std::uint64_t start = file.offset();
  if (bytes > file_bytes - start) fail("an attribute of its header is longer than the file");
  if (name == "dataWindow") read_data_window(file, part);
  if (name == "compression") {
    part.block_rows = kBlockRows[std::min<std::size_t>(file.byte(), kBlockRows.size() - 1)];
  }
  if (name == "tiles") {
    part.tile_width = file.little_endian(4);
    part.tile_height = file.little_endian(4);
  }
  file.seek(start + bytes);
  return !file.ended();
}

std::uint64_t pieces(std::uint64_t whole, std::uint64_t piece) {
  return (whole + piece - 1) / piece;
}

std::uint64_t blocks(const Part& part) {
  if (part.tile_width == 0 || part.tile_height == 0) return pieces(part.height, part.block_rows);
  return pieces(part.width, part.tile_width) * pieces(part.height, part.tile_height);
}

}  // namespace

void check_exr_tables(const std::string& path) {
  HeaderBytes file(path);
  if (file.little_endian(4) != kMagic) return;
  const bool several_parts = (file.little_endian(4) & kMultiPart) != 0;
  const std::uint64_t file_bytes = file.file_bytes();
  while (!file.ended()) {
    Part part;
    bool empty = true;
    while (read_attribute(file, file_bytes, part)) empty = false;
    // The table has eight bytes a block.
    if (blocks(part) > file_bytes / 8) fail("its header names more rows than the file holds");
    if (empty || !several_parts) return;
  }
}

}  // namespace atlasgauge
