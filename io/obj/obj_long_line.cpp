#include "io/obj/obj_long_line.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "io/error.hpp"
#include "io/obj/obj_numbers.hpp"

namespace atlasgauge {
namespace {

/// Longer than any known keyword, and than what a warning shows.
constexpr std::size_t kKeptKeywordBytes = 64;

bool has_zero_byte(const char* text, const char* end) {
  return std::string_view(text, static_cast<std::size_t>(end - text)).find('\0') !=
         std::string_view::npos;
}

}  // namespace

ObjLongLine::ObjLongLine(std::string path) : path_(std::move(path)) {}

void ObjLongLine::begin(const Before& before) {
  before_ = before;
  part_ = Part::kKeyword;
  statement_ = ObjStatement::kIgnored;
  word_.clear();
  has_zero_byte_ = false;
  name_bytes_ = 0;
  words_ = 0;
  position_ = {};
  texcoord_ = {};
  defect_ = ObjDefect::kNone;
  triangles_ = 0;
  max_vertex_ = 0;
}

const char* ObjLongLine::feed(const char* text, const char* end, FixedArray<FaceRecord>& faces) {
  while (text != end && !faces.full()) {
    switch (part_) {
      case Part::kKeyword:
        text = feed_keyword(text, end);
        break;
      case Part::kWords:
        text = feed_words(text, end, faces);
        break;
      case Part::kName:
        text = feed_name(text, end);
        break;
      case Part::kIgnored:
        text = feed_ignored(text, end);
        break;
    }
  }
  return text;
}

ObjDefect ObjLongLine::defect() const {
  return words_ < 3 ? ObjDefect::kFewCorners : defect_;
}

const char* ObjLongLine::feed_keyword(const char* text, const char* end) {
  if (word_.empty()) text = std::find_if_not(text, end, is_blank);
  if (text == end) return end;
  const char* const word_end = std::find_if(text, end, is_word_end);
  has_zero_byte_ = has_zero_byte_ || has_zero_byte(text, word_end);
  const auto bytes = static_cast<std::size_t>(word_end - text);
  word_.append(text, std::min(bytes, kKeptKeywordBytes - word_.size()));
  if (word_end != end) end_keyword();
  return word_end;
}

void ObjLongLine::end_keyword() {
  statement_ = classify_statement(word_);
  switch (statement_) {
    case ObjStatement::kPosition:
    case ObjStatement::kTexCoord:
    case ObjStatement::kFace:
      part_ = Part::kWords;
      break;
    case ObjStatement::kMaterial:
    case ObjStatement::kLibrary:
      part_ = Part::kName;
      break;
    case ObjStatement::kPrimitive:
    case ObjStatement::kIgnored:
    case ObjStatement::kUnknown:
      part_ = Part::kIgnored;
      if (statement_ == ObjStatement::kUnknown && has_zero_byte_) fail(binary_content());
      return;
  }
  word_.clear();
}

const char* ObjLongLine::feed_words(const char* text, const char* end,
                                    FixedArray<FaceRecord>& faces) {
  if (word_.empty()) {
    text = std::find_if_not(text, end, is_blank);
    if (text == end) return end;
    if (*text == '#' || *text == '\n') {
      part_ = Part::kIgnored;
      return text;
    }
  }
  const char* const word_end = std::find_if(text, end, is_word_end);
  const std::string_view rest(text, static_cast<std::size_t>(word_end - text));
  if (rest.size() > kMaxWordBytes - word_.size()) fail(overlong_word("a word"));
  if (word_.empty() && word_end != end) {
    read_word(rest, faces);
    return word_end;
  }
  word_ += rest;
  if (word_end != end) read_kept_word(faces);
  return word_end;
}

void ObjLongLine::read_kept_word(FixedArray<FaceRecord>& faces) {
  const std::size_t word_bytes = word_.size();
  word_.append(1 + kReadAheadBytes, '\n');
  read_word({word_.data(), word_bytes}, faces);
  word_.clear();
}

void ObjLongLine::read_word(std::string_view word, FixedArray<FaceRecord>& faces) {
  if (statement_ == ObjStatement::kPosition) read_position_word(word);
  if (statement_ == ObjStatement::kTexCoord) read_texcoord_word(word);
  if (statement_ == ObjStatement::kFace) read_corner_word(word, faces);
  ++words_;
}

void ObjLongLine::read_position_word(std::string_view word) {
  if (words_ > 2) return;
  double& value = words_ == 0 ? position_.x : words_ == 1 ? position_.y : position_.z;
  if (read_double(word.data(), value) != nullptr) return;
  fail(unreadable_coordinate("xyz"[words_], word));
}

void ObjLongLine::read_texcoord_word(std::string_view word) {
  if (words_ > 1) return;
  float& value = words_ == 0 ? texcoord_.u : texcoord_.v;
  if (read_float(word.data(), value) != nullptr) return;
  fail(unreadable_coordinate("uv"[words_], word));
}

void ObjLongLine::read_corner_word(std::string_view word, FixedArray<FaceRecord>& faces) {
  ObjCorner corner;
  if (read_corner(word.data(), corner) == nullptr) {
    fail(unreadable_corner(word));
  }
  const std::size_t at = std::min<std::uint64_t>(words_, 2);
  fan_.v[at] = vertex(corner.vertex);
  fan_.t[at] = texcoord_index(corner.texcoord);
  if (words_ < 2 || defect_ != ObjDefect::kNone) return;
  fan_.material = before_.material;
  faces.push(fan_);
  ++triangles_;
  fan_.v[1] = fan_.v[2];
  fan_.t[1] = fan_.t[2];
}

VertexId ObjLongLine::vertex(std::int64_t index) {
  const std::int64_t before = index < 0 ? static_cast<std::int64_t>(before_.positions) : -1;
  const std::int64_t absolute = index + before;
  if (index == 0 || absolute < 0 || absolute >= static_cast<std::int64_t>(kMaxElements)) {
    defect_ = index == 0 ? ObjDefect::kIndexZero : ObjDefect::kNoSuchVertex;
    return kNone<VertexId>;
  }
  max_vertex_ = std::max(max_vertex_, static_cast<std::uint64_t>(absolute));
  return VertexId{static_cast<std::uint32_t>(absolute)};
}

TexCoordId ObjLongLine::texcoord_index(std::int64_t index) const {
  const std::int64_t before = index < 0 ? static_cast<std::int64_t>(before_.texcoords) : -1;
  const std::int64_t absolute = index + before;
  if (index == 0 || absolute < 0 || absolute >= raw(kNone<TexCoordId>)) return kNone<TexCoordId>;
  return TexCoordId{static_cast<std::uint32_t>(absolute)};
}

const char* ObjLongLine::feed_name(const char* text, const char* end) {
  for (; text != end; ++text) {
    const bool at_word = name_bytes_ != word_.size() || word_.empty();
    if (*text == '\n' || (at_word && *text == '#')) {
      word_.resize(name_bytes_);
      part_ = Part::kIgnored;
      return text;
    }
    add_name_byte(*text);
  }
  return text;
}

/// Blanks at the end of a name do not belong to it, so they are no reason to refuse it.
void ObjLongLine::add_name_byte(char c) {
  if (is_blank(c)) {
    if (!word_.empty() && word_.size() <= kMaxWordBytes) word_.push_back(c);
    return;
  }
  if (word_.size() >= kMaxWordBytes) {
    fail(overlong_word(statement_ == ObjStatement::kMaterial ? "a material name" : "a file name"));
  }
  word_.push_back(c);
  name_bytes_ = word_.size();
}

const char* ObjLongLine::feed_ignored(const char* text, const char* end) {
  if (statement_ == ObjStatement::kUnknown && has_zero_byte(text, end)) fail(binary_content());
  if (end[-1] == '\n') require_coordinates();
  return end;
}

void ObjLongLine::require_coordinates() const {
  if (statement_ == ObjStatement::kPosition && words_ < 3) {
    fail(unreadable_coordinate("xyz" [words_], {}));
  }
  if (statement_ == ObjStatement::kTexCoord && words_ < 1) fail(unreadable_coordinate('u', {}));
}

void ObjLongLine::fail(std::string_view text) const {
  throw Error(ErrorKind::kInput, path_, before_.line, std::string(text));
}

}  // namespace atlasgauge
