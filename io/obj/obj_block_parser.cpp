#include "io/obj/obj_block_parser.hpp"

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "io/warnings.hpp"

namespace atlasgauge {
namespace {

/// A corner as FaceRecord has it.
struct Wedge {
  std::uint32_t v;
  std::uint32_t t;
  std::uint32_t marks;
};

bool fits_relative(std::int64_t index) {
  return index >= std::numeric_limits<std::int32_t>::min();
}

class LineParser {
 public:
  explicit LineParser(ObjBlock& block)
      : block_(block), text_end_(block.text.data() + block.text.size()) {}

  void run();

 private:
  // Each statement takes the text after its keyword and returns its line end, or nullptr when
  // parsing must stop before this line.
  const char* statement(const char* text);
  const char* position(const char* text);
  const char* texcoord(const char* text);
  const char* face(const char* text);
  const char* rare_statement(const char* text);
  const char* material(const char* text, const char* line_end);
  const char* library(const char* text, const char* line_end);
  const char* unknown(std::string_view keyword, const char* text, const char* line_end);

  void push_face(const Wedge& a, const Wedge& b, const Wedge& c);
  const char* read_wedge(const char* text, Wedge& wedge);
  const char* read_rare_wedge(const char* text, Wedge& wedge);
  std::uint32_t vertex(std::int64_t index, std::uint32_t& marks);
  std::uint32_t texcoord_index(std::int64_t index, std::uint32_t& marks) const;
  void end_polygon(std::size_t first_face, std::size_t corners);
  void note(ObjDefect defect, std::string_view keyword, std::uint64_t occurrences);

  const char* fail(std::string text);
  const char* fail_coordinate(char axis, const char* text);
  const char* stop_at_full_faces(std::size_t first_face, const char* text);
  const char* find_line_end(const char* text) const;
  ObjBlock::Name name(std::string_view text) const;

  ObjBlock& block_;
  const char* text_end_;
  const char* line_begin_ = nullptr;
  ObjDefect defect_ = ObjDefect::kNone;  // of the polygon being read
};

void LineParser::run() {
  const char* const begin = block_.text.data();
  line_begin_ = begin + block_.parsed_bytes;
  while (line_begin_ != text_end_) {
    const char* const line_end = statement(skip_blanks(line_begin_));
    if (line_end == nullptr) break;
    ++block_.parsed_lines;
    if (block_.spliced) {
      block_.parsed_lines += static_cast<std::uint32_t>(std::count(line_begin_, line_end, '\v'));
    }
    line_begin_ = line_end + 1;
  }
  block_.parsed_bytes = static_cast<std::size_t>(line_begin_ - begin);
}

const char* LineParser::statement(const char* text) {
  const char* line_end = nullptr;
  if (text[0] == 'v' && is_blank(text[1])) {
    line_end = position(text + 1);
  } else if (text[0] == 'f' && is_blank(text[1])) {
    line_end = face(text + 1);
  } else if (text[0] == 'v' && text[1] == 't' && is_blank(text[2])) {
    line_end = texcoord(text + 2);
  } else {
    return rare_statement(text);
  }
  if (line_end == nullptr || line_end - line_begin_ <= std::ptrdiff_t{kMaxWordBytes})
    return line_end;
  const bool overlong = has_overlong_word({line_begin_, line_end});
  return overlong ? fail(overlong_word("a word")) : line_end;
}

const char* LineParser::position(const char* text) {
  if (block_.positions.full()) return nullptr;
  Position position;
  const char* p = skip_blanks(text);
  const char* word_end = read_double(p, position.x);
  if (word_end == nullptr) return fail_coordinate('x', p);
  p = skip_blanks(word_end);
  word_end = read_double(p, position.y);
  if (word_end == nullptr) return fail_coordinate('y', p);
  p = skip_blanks(word_end);
  word_end = read_double(p, position.z);
  if (word_end == nullptr) return fail_coordinate('z', p);
  block_.positions.push(position);
  if (!is_finite(position)) [[unlikely]] {
    note(ObjDefect::kPositionNotFinite, {}, ++block_.not_finite);
  }
  return *word_end == '\n' ? word_end : find_line_end(word_end);
}

const char* LineParser::texcoord(const char* text) {
  if (block_.texcoords.full()) return nullptr;
  TexCoord texcoord{};
  const char* p = skip_blanks(text);
  const char* word_end = read_float(p, texcoord.u);
  if (word_end == nullptr) return fail_coordinate('u', p);
  p = skip_blanks(word_end);
  if (*p != '\n' && *p != '#') {
    word_end = read_float(p, texcoord.v);
    if (word_end == nullptr) return fail_coordinate('v', p);
  }
  block_.texcoords.push(texcoord);
  if (!is_finite(texcoord)) [[unlikely]] {
    note(ObjDefect::kTexCoordNotFinite, {}, ++block_.not_finite);
  }
  return *word_end == '\n' ? word_end : find_line_end(word_end);
}

const char* LineParser::face(const char* text) {
  if (block_.polygons.full()) return nullptr;
  const std::size_t first_face = block_.faces.size();
  std::size_t corners = 0;
  Wedge first{};
  Wedge previous{};
  defect_ = ObjDefect::kNone;
  const char* p = skip_blanks(text);
  for (; *p != '\n' && *p != '#'; ++corners) {
    Wedge current{};
    const char* const word_end = read_wedge(p, current);
    if (word_end == nullptr) {
      block_.faces.resize(first_face);
      return fail(unreadable_corner(word_at(p)));
    }
    p = skip_blanks(word_end);
    if (corners == 0) first = current;
    if (corners >= 2 && defect_ == ObjDefect::kNone) {
      if (block_.faces.full()) return stop_at_full_faces(first_face, p);
      push_face(first, previous, current);
    }
    previous = current;
  }
  end_polygon(first_face, corners);
  return *p == '\n' ? p : find_line_end(p);
}

inline const char* LineParser::read_wedge(const char* text, Wedge& wedge) {
  const char* const word_end = read_plain_corner(text, wedge.v, wedge.t);
  if (word_end == nullptr) return read_rare_wedge(text, wedge);
  --wedge.v;
  --wedge.t;  // 0 becomes kNone
  return word_end;
}

const char* LineParser::read_rare_wedge(const char* text, Wedge& wedge) {
  ObjCorner corner;
  const char* const word_end = read_corner(text, corner);
  if (word_end == nullptr) return nullptr;
  wedge.v = vertex(corner.vertex, wedge.marks);
  wedge.t = texcoord_index(corner.texcoord, wedge.marks);
  return word_end;
}

void LineParser::push_face(const Wedge& a, const Wedge& b, const Wedge& c) {
  block_.faces.push({{VertexId{a.v}, VertexId{b.v}, VertexId{c.v}},
                     {TexCoordId{a.t}, TexCoordId{b.t}, TexCoordId{c.t}},
                     MaterialId{a.marks | b.marks << 1 | c.marks << 2}});
}

std::uint32_t LineParser::vertex(std::int64_t index, std::uint32_t& marks) {
  constexpr auto kMaxIndex = static_cast<std::int64_t>(kMaxElements);
  if (index > 0 && index <= kMaxIndex) return static_cast<std::uint32_t>(index - 1);
  const std::int64_t relative =
      std::min<std::int64_t>(index, 0) + static_cast<std::int64_t>(block_.positions.size());
  if (index < 0 && fits_relative(relative)) {
    marks |= ObjBlock::kRelativeVertex;
    block_.has_relative = true;
    return static_cast<std::uint32_t>(relative);
  }
  defect_ = index == 0 ? ObjDefect::kIndexZero : ObjDefect::kNoSuchVertex;
  return 0;
}

std::uint32_t LineParser::texcoord_index(std::int64_t index, std::uint32_t& marks) const {
  constexpr std::uint32_t kNoTexCoord = raw(kNone<TexCoordId>);
  if (index > 0) return static_cast<std::uint32_t>(std::min<std::int64_t>(index - 1, kNoTexCoord));
  const std::int64_t relative = index + static_cast<std::int64_t>(block_.texcoords.size());
  if (index == 0 || !fits_relative(relative)) return kNoTexCoord;
  marks |= ObjBlock::kRelativeTexCoord;
  block_.has_relative = true;
  return static_cast<std::uint32_t>(relative);
}

void LineParser::end_polygon(std::size_t first_face, std::size_t corners) {
  if (corners < 3) defect_ = ObjDefect::kFewCorners;
  if (defect_ == ObjDefect::kNone) {
    block_.polygons.push({static_cast<std::uint32_t>(first_face), block_.parsed_lines});
    return;
  }
  block_.faces.resize(first_face);
  note(defect_, {}, ++block_.invalid_polygons);
}

const char* LineParser::rare_statement(const char* text) {
  const std::string_view keyword = word_at(text);
  const char* const line_end = find_line_end(text);
  const char* const after = keyword.data() + keyword.size();
  switch (classify_statement(keyword)) {
    case ObjStatement::kPosition:
      return position(after);
    case ObjStatement::kTexCoord:
      return texcoord(after);
    case ObjStatement::kFace:
      return face(after);
    case ObjStatement::kMaterial:
      return material(after, line_end);
    case ObjStatement::kLibrary:
      return library(after, line_end);
    case ObjStatement::kPrimitive:
      ++block_.skipped_primitives;
      return line_end;
    case ObjStatement::kIgnored:
      return line_end;
    case ObjStatement::kUnknown:
      return unknown(keyword, text, line_end);
  }
  return line_end;
}

const char* LineParser::material(const char* text, const char* line_end) {
  if (block_.materials.full()) return nullptr;
  const char* const begin = skip_blanks(text);
  const std::string_view material = without_comment({begin, line_end});
  if (material.size() > kMaxWordBytes) return fail(overlong_word("a material name"));
  block_.materials.push({static_cast<std::uint32_t>(block_.faces.size()), name(material)});
  return line_end;
}

const char* LineParser::library(const char* text, const char* line_end) {
  if (block_.libraries.full()) return nullptr;
  const std::string_view library = without_comment({skip_blanks(text), line_end});
  if (library.size() > kMaxWordBytes) return fail(overlong_word("a file name"));
  block_.libraries.push(name(library));
  return line_end;
}

const char* LineParser::unknown(std::string_view keyword, const char* text, const char* line_end) {
  if (std::find(text, line_end, '\0') != line_end) return fail(binary_content());
  note(ObjDefect::kNone, keyword, ++block_.unknown_statements);
  return line_end;
}

void LineParser::note(ObjDefect defect, std::string_view keyword, std::uint64_t occurrences) {
  if (occurrences > Warnings::kShownPerKind) return;
  block_.oddities.push_back({block_.parsed_lines, defect, name(keyword)});
}

const char* LineParser::fail(std::string text) {
  block_.fault = {block_.parsed_lines, std::move(text)};
  return nullptr;
}

const char* LineParser::fail_coordinate(char axis, const char* text) {
  return fail(unreadable_coordinate(axis, word_at(text)));
}

/// The polygon is read again when the faces before it are committed, or word by word if it alone
/// is too much.
const char* LineParser::stop_at_full_faces(std::size_t first_face, const char* text) {
  block_.faces.resize(first_face);
  if (first_face == 0) {
    block_.wide_line_bytes = static_cast<std::size_t>(find_line_end(text) + 1 - line_begin_);
  }
  return nullptr;
}

const char* LineParser::find_line_end(const char* text) const {
  return static_cast<const char*>(
      std::memchr(text, '\n', static_cast<std::size_t>(text_end_ - text)));
}

ObjBlock::Name LineParser::name(std::string_view text) const {
  if (text.empty()) return {0, 0};
  return {static_cast<std::uint32_t>(text.data() - block_.text.data()),
          static_cast<std::uint32_t>(text.size())};
}

}  // namespace

void splice_lines(ObjBlock& block) {
  char* const text = block.text.data();
  const std::string_view view(text, block.text.size());
  for (std::size_t at = view.find('\\'); at != std::string_view::npos;
       at = view.find('\\', at + 1)) {
    const std::size_t line_end = at + (view.substr(at + 1).starts_with('\r') ? 2 : 1);
    if (line_end >= view.size() || view[line_end] != '\n') continue;
    // From here on, '\v' stands for line ends only.
    if (!block.spliced) std::replace(text, text + view.size(), '\v', ' ');
    std::fill(text + at, text + line_end, ' ');
    text[line_end] = '\v';
    block.spliced = true;
  }
}

void parse_lines(ObjBlock& block) {
  LineParser(block).run();
}

}  // namespace atlasgauge
