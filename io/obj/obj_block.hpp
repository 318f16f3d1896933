#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/mesh_batch.hpp"
#include "io/obj/fixed_array.hpp"
#include "io/obj/obj_statement.hpp"

namespace atlasgauge {

/// Text of an OBJ file and what was read from it. Reusable: after the first use it allocates
/// nothing but the texts of warnings. Drivers only carry it from ObjReader::next() to parse() to
/// commit().
///
/// Its memory is bounded by arrays of fixed size, whose sizes suit the lines of real scans. Text
/// that is denser ("f 1 1 1 1 ..." makes 28 bytes from 2) fills an array before the text ends;
/// parsing then stops at a line, and goes on when the values so far are committed.
struct ObjBlock {
  enum class Kind {
    kWholeLines,
    kPiece,      ///< part of a line longer than a block; more follows
    kLastPiece,  ///< the end of such a line
  };

  /// Triangles from first_face on, up to the next polygon's.
  struct Polygon {
    std::uint32_t first_face;
    std::uint32_t line;
  };

  /// A part of the text.
  struct Name {
    std::uint32_t offset;
    std::uint32_t length;
  };

  /// `usemtl` before face first_face.
  struct MaterialSwitch {
    std::uint32_t first_face;
    Name name;
  };

  /// Something to warn about: a defect, or an unknown statement (kNone).
  struct Oddity {
    std::uint32_t line;
    ObjDefect defect;
    Name keyword;
  };

  struct Fault {
    std::uint32_t line;
    std::string text;
  };

  /// Marks in FaceRecord::material until commit() puts the material there: v[i] is relative to the
  /// positions, t[i] to the texture coordinates before this block (as a signed number).
  static constexpr std::uint32_t kRelativeVertex = 1U << 0;
  static constexpr std::uint32_t kRelativeTexCoord = 1U << 3;

  /// Room for a block of text; does nothing but clear() if there is room already.
  void allocate(std::size_t block_bytes);
  static std::size_t memory_bytes(std::size_t block_bytes);

  /// Forgets what was parsed, not the text.
  void clear_values();

  std::string_view text_of(Name name) const { return {text.data() + name.offset, name.length}; }
  std::string_view rest() const { return {text.data() + parsed_bytes, text.size() - parsed_bytes}; }

  Kind kind = Kind::kWholeLines;
  FixedArray<char> text;  ///< ends with '\n' unless it is a kPiece
  bool spliced = false;   ///< line ends were taken away by backslashes; '\v' stands in their place

  std::size_t parsed_bytes = 0;  ///< text before it is parsed
  std::uint32_t parsed_lines = 0;
  std::size_t wide_line_bytes = 0;  ///< the next line's, if one polygon in it fills `faces`

  FixedArray<Position> positions;
  FixedArray<TexCoord> texcoords;
  FixedArray<FaceRecord> faces;
  FixedArray<Polygon> polygons;
  FixedArray<MaterialSwitch> materials;
  FixedArray<Name> libraries;

  bool has_relative = false;
  std::uint64_t invalid_polygons = 0;
  std::uint64_t skipped_primitives = 0;
  std::uint64_t unknown_statements = 0;
  std::uint64_t not_finite = 0;  ///< positions and texture coordinates
  std::vector<Oddity> oddities;  ///< the first few of each kind, by line
  std::optional<Fault> fault;    ///< at the first line that cannot be read; parsing ended there
};

}  // namespace atlasgauge
