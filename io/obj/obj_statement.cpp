#include "io/obj/obj_statement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

namespace atlasgauge {
namespace {

constexpr std::array<std::string_view, 10> kPrimitives = {"p",   "l",   "curv", "curv2", "surf",
                                                          "bsp", "bzp", "cdc",  "cdp",   "fo"};

/// Statements of the format that say nothing about triangles, and two that are common in files of
/// subdivision surfaces: "t" (crease tags) and "vw" (skin weights).
constexpr std::array<std::string_view, 32> kIgnoredKeywords = {
    "vn",         "vp",        "g",     "o",     "s",     "mg",       "usemap",   "maplib",
    "cstype",     "deg",       "bmat",  "step",  "parm",  "trim",     "hole",     "scrv",
    "sp",         "end",       "con",   "res",   "bevel", "c_interp", "d_interp", "lod",
    "shadow_obj", "trace_obj", "ctech", "stech", "call",  "csh",      "t",        "vw"};

std::string quoted(std::string_view word) {
  constexpr std::size_t kShownBytes = 40;
  std::string text = "\"";
  for (const char c : word.substr(0, kShownBytes)) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::iscntrl(byte) != 0) {
      text += fmt::format("\\x{:02x}", byte);
    } else {
      text += c;
    }
  }
  return text + (word.size() > kShownBytes ? "...\"" : "\"");
}

/// A comment ends the line, whatever it holds.
bool is_line_end(std::string_view word) {
  return word.empty() || word.front() == '#';
}

bool is_binary(std::string_view word) {
  return !is_line_end(word) && word.find('\0') != std::string_view::npos;
}

std::string found(std::string_view word) {
  return is_line_end(word) ? "found the end of the line" : "found " + quoted(word);
}

}  // namespace

ObjStatement classify_statement(std::string_view keyword) {
  if (keyword.empty() || keyword.front() == '#') return ObjStatement::kIgnored;
  if (keyword == "v") return ObjStatement::kPosition;
  if (keyword == "vt") return ObjStatement::kTexCoord;
  if (keyword == "f") return ObjStatement::kFace;
  if (keyword == "usemtl") return ObjStatement::kMaterial;
  if (keyword == "mtllib") return ObjStatement::kLibrary;
  if (std::ranges::find(kPrimitives, keyword) != kPrimitives.end()) return ObjStatement::kPrimitive;
  const bool ignored = std::ranges::find(kIgnoredKeywords, keyword) != kIgnoredKeywords.end();
  return ignored ? ObjStatement::kIgnored : ObjStatement::kUnknown;
}

std::string_view defect_text(ObjDefect defect) {
  switch (defect) {
    case ObjDefect::kNone:
      return "";
    case ObjDefect::kFewCorners:
      return "polygon dropped: it has fewer than three corners";
    case ObjDefect::kIndexZero:
      return "polygon dropped: it has the vertex index 0, but indices begin at 1";
    case ObjDefect::kNoSuchVertex:
      return "polygon dropped: it names a vertex that does not exist";
    case ObjDefect::kPositionNotFinite:
      return "the position is not finite: faces that use it are counted, but not measured";
    case ObjDefect::kTexCoordNotFinite:
      return "the texture coordinate is not finite: taken as none";
  }
  return "";
}

std::string unreadable_coordinate(char axis, std::string_view word) {
  if (is_binary(word)) return binary_content();
  return fmt::format(
      "{} where a number is expected for {}; mend the line or export the model again", found(word),
      axis);
}

std::string unreadable_corner(std::string_view word) {
  if (is_binary(word)) return binary_content();
  return fmt::format(
      "{} where a face corner like 1, 1/2, 1//3 or 1/2/3 is expected; mend the line or export the "
      "model again",
      found(word));
}

std::string overlong_word(std::string_view what) {
  return fmt::format("found {} of more than {} bytes; is this file an OBJ model?", what,
                     kMaxWordBytes);
}

std::string unknown_statement(std::string_view keyword) {
  return fmt::format("statement {} is unknown and ignored", quoted(keyword));
}

std::string binary_content() {
  return "found zero bytes, so this is a binary file or UTF-16 text, but an OBJ model is plain "
         "text (ASCII or UTF-8); convert it or export it again";
}

std::string_view without_comment(std::string_view line) {
  bool at_word = true;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (at_word && line[i] == '#')
      line = line.substr(0, i);
    else
      at_word = is_blank(line[i]);
  }
  while (!line.empty() && is_blank(line.back())) line.remove_suffix(1);
  return line;
}

bool has_overlong_word(std::string_view line) {
  std::size_t word_bytes = 0;
  for (const char c : without_comment(line)) {
    word_bytes = is_blank(c) ? 0 : word_bytes + 1;
    if (word_bytes > kMaxWordBytes) return true;
  }
  return false;
}

}  // namespace atlasgauge
