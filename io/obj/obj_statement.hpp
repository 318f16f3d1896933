#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/obj/obj_numbers.hpp"

namespace atlasgauge {

/// A word or a name longer than this is refused, so that a line of any length can be read in
/// constant memory and gives the same result whether it fits a block or not.
inline constexpr std::size_t kMaxWordBytes = std::size_t{64} << 10;

/// What a line is, by its first word.
enum class ObjStatement {
  kPosition,
  kTexCoord,
  kFace,
  kMaterial,   ///< usemtl
  kLibrary,    ///< mtllib
  kPrimitive,  ///< points, lines, curves and surfaces: skipped and counted
  kIgnored,    ///< known, without meaning here; comments and empty lines too
  kUnknown,
};

ObjStatement classify_statement(std::string_view keyword);

/// The indices of a face corner as written, 0 where there is none.
struct ObjCorner {
  std::int64_t vertex = 0;
  std::int64_t texcoord = 0;
};

/// Reads "v", "v/t", "v//n" or "v/t/n"; a normal index is skipped unread. Returns the end of the
/// word, or nullptr if an index cannot be read.
inline const char* read_corner(const char* text, ObjCorner& corner) {
  const char* p = read_index(text, corner.vertex);
  corner.texcoord = 0;
  if (p == nullptr || *p != '/') return p;
  ++p;
  if (*p != '/' && !is_word_end(*p)) p = read_index(p, corner.texcoord);
  if (p == nullptr || *p != '/') return p;
  return skip_word(p);
}

/// The same for the usual "v", "v/t" and "v/t/n" with indices in [1, 10^9). Returns nullptr for
/// every other corner, right or wrong. Without a texture index, that is 0.
[[gnu::always_inline]] inline const char* read_plain_corner(const char* text, std::uint32_t& vertex,
                                                            std::uint32_t& texcoord) {
  constexpr std::ptrdiff_t kMostDigits = 9;
  vertex = 0;
  texcoord = 0;
  const char* p = numbers::append_many_digits(text, vertex);
  if (vertex == 0 || p - text > kMostDigits) return nullptr;
  if (*p == '/') {
    const char* const begin = p + 1;
    p = numbers::append_many_digits(begin, texcoord);
    if (texcoord == 0 || p - begin > kMostDigits) return nullptr;
    if (*p == '/') p = skip_word(p);
  }
  return is_word_end(*p) ? p : nullptr;
}

/// Why a polygon is dropped, or what else is wrong with a statement that can be read.
enum class ObjDefect : std::uint8_t {
  kNone,
  kFewCorners,
  kIndexZero,
  kNoSuchVertex,
  kPositionNotFinite,
  kTexCoordNotFinite,
};

std::string_view defect_text(ObjDefect defect);

/// Texts of errors. `word` is what stands in the line, empty where the line has ended.
std::string unreadable_coordinate(char axis, std::string_view word);
std::string unreadable_corner(std::string_view word);
std::string overlong_word(std::string_view what);
std::string unknown_statement(std::string_view keyword);
std::string binary_content();

/// The end of the text in `line` (without its line end) that is not a comment, and not blank.
std::string_view without_comment(std::string_view line);

/// True when a word of the line, comments aside, is longer than kMaxWordBytes.
bool has_overlong_word(std::string_view line);

}  // namespace atlasgauge
