#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/mesh_batch.hpp"
#include "io/obj/fixed_array.hpp"
#include "io/obj/obj_statement.hpp"

namespace atlasgauge {

/// One statement of any length, read word by word in constant memory. Its text comes in pieces cut
/// anywhere, with backslash continuations spliced; the last piece ends with '\n'.
class ObjLongLine {
 public:
  /// The model where the line begins.
  struct Before {
    std::uint64_t line;
    std::uint64_t positions;
    std::uint64_t texcoords;
    MaterialId material;
  };

  explicit ObjLongLine(std::string path);

  void begin(const Before& before);

  /// Reads on. The triangles of a polygon go to `faces`; returns where it stopped, which is short
  /// of `end` if there is no more room. kReadAheadBytes after `end` must be readable, too. Throws
  /// Error(kInput).
  const char* feed(const char* text, const char* end, FixedArray<FaceRecord>& faces);

  /// What the line turned out to be. The rest is valid when the whole line was fed.
  ObjStatement statement() const { return statement_; }
  const Position& position() const { return position_; }
  const TexCoord& texcoord() const { return texcoord_; }
  /// The keyword of an unknown statement, or the rest of a `usemtl` or `mtllib` line.
  std::string_view text() const { return word_; }
  ObjDefect defect() const;
  std::uint64_t triangles() const { return triangles_; }
  /// The largest vertex the polygon names, counted from 0.
  std::uint64_t max_vertex() const { return max_vertex_; }

 private:
  enum class Part { kKeyword, kWords, kName, kIgnored };

  const char* feed_keyword(const char* text, const char* end);
  const char* feed_words(const char* text, const char* end, FixedArray<FaceRecord>& faces);
  const char* feed_name(const char* text, const char* end);
  const char* feed_ignored(const char* text, const char* end);

  void end_keyword();
  void read_kept_word(FixedArray<FaceRecord>& faces);
  void read_word(std::string_view word, FixedArray<FaceRecord>& faces);
  void read_position_word(std::string_view word);
  void read_texcoord_word(std::string_view word);
  void read_corner_word(std::string_view word, FixedArray<FaceRecord>& faces);
  VertexId vertex(std::int64_t index);
  TexCoordId texcoord_index(std::int64_t index) const;
  void add_name_byte(char c);
  void require_coordinates() const;
  [[noreturn]] void fail(std::string_view text) const;

  std::string path_;
  Before before_{};
  Part part_ = Part::kKeyword;
  ObjStatement statement_ = ObjStatement::kIgnored;
  std::string word_;  // so far; a name with its blanks
  bool has_zero_byte_ = false;
  std::size_t name_bytes_ = 0;  // of word_, without the blanks at its end
  std::uint64_t words_ = 0;     // after the keyword
  Position position_{};
  TexCoord texcoord_{};
  FaceRecord fan_{};
  ObjDefect defect_ = ObjDefect::kNone;
  std::uint64_t triangles_ = 0;
  std::uint64_t max_vertex_ = 0;
};

}  // namespace atlasgauge
