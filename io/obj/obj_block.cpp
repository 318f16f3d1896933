#include "io/obj/obj_block.hpp"

#include <algorithm>

namespace atlasgauge {
namespace {

/// A final line end, and one more if a backslash escapes it.
constexpr std::size_t kAddedLineEnds = 2;

constexpr std::size_t text_room(std::size_t block_bytes) {
  return block_bytes + kAddedLineEnds + kReadAheadBytes;
}

/// Elements for which a block has room: one for so many bytes of text. Few lines of scans are
/// shorter: "v 1.23 4.56 7.89", "vt 0.12 0.34", "f 123 124 125".
constexpr std::size_t position_room(std::size_t block_bytes) {
  return block_bytes / 16 + 4;
}
constexpr std::size_t texcoord_room(std::size_t block_bytes) {
  return block_bytes / 12 + 4;
}
constexpr std::size_t face_room(std::size_t block_bytes) {
  return block_bytes / 14 + 4;
}
constexpr std::size_t name_room(std::size_t block_bytes) {
  return block_bytes / 128 + 4;
}

/// Oddities and texts of errors and warnings.
constexpr std::size_t kSmallThings = std::size_t{16} << 10;

}  // namespace

void ObjBlock::allocate(std::size_t block_bytes) {
  text.allocate(text_room(block_bytes));
  positions.allocate(position_room(block_bytes));
  texcoords.allocate(texcoord_room(block_bytes));
  faces.allocate(face_room(block_bytes));
  polygons.allocate(face_room(block_bytes));
  materials.allocate(name_room(block_bytes));
  libraries.allocate(name_room(block_bytes));
  kind = Kind::kWholeLines;
  spliced = false;
  parsed_bytes = 0;
  parsed_lines = 0;
  clear_values();
}

std::size_t ObjBlock::memory_bytes(std::size_t block_bytes) {
  return text_room(block_bytes) + position_room(block_bytes) * sizeof(Position) +
         texcoord_room(block_bytes) * sizeof(TexCoord) +
         face_room(block_bytes) * (sizeof(FaceRecord) + sizeof(Polygon)) +
         name_room(block_bytes) * (sizeof(MaterialSwitch) + sizeof(Name)) + sizeof(ObjBlock) +
         kSmallThings;
}

void ObjBlock::clear_values() {
  wide_line_bytes = 0;
  positions.resize(0);
  texcoords.resize(0);
  faces.resize(0);
  polygons.resize(0);
  materials.resize(0);
  libraries.resize(0);
  has_relative = false;
  invalid_polygons = 0;
  skipped_primitives = 0;
  unknown_statements = 0;
  not_finite = 0;
  oddities.clear();
  fault.reset();
}

}  // namespace atlasgauge
