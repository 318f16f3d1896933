#include "io/ply/ply_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "io/error.hpp"
#include "io/name_room.hpp"
#include "io/obj/obj_numbers.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kMaxLineBytes = std::size_t{16} << 10;

/// More say nothing about a mesh, and would not be constant memory.
constexpr std::size_t kMaxProperties = 4096;

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr std::array kTypeNames = {
    TypeName{"char", PlyType::kInt8},      TypeName{"int8", PlyType::kInt8},
    TypeName{"uchar", PlyType::kUint8},    TypeName{"uint8", PlyType::kUint8},
    TypeName{"short", PlyType::kInt16},    TypeName{"int16", PlyType::kInt16},
    TypeName{"ushort", PlyType::kUint16},  TypeName{"uint16", PlyType::kUint16},
    TypeName{"int", PlyType::kInt32},      TypeName{"int32", PlyType::kInt32},
    TypeName{"uint", PlyType::kUint32},    TypeName{"uint32", PlyType::kUint32},
    TypeName{"float", PlyType::kFloat32},  TypeName{"float32", PlyType::kFloat32},
    TypeName{"double", PlyType::kFloat64}, TypeName{"float64", PlyType::kFloat64},
};

std::string_view without_blanks_around(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  return text;
}

/// Takes the first word off a line, with the blanks around it.
std::string_view take_word(std::string_view& line) {
  line = without_blanks_around(line);
  const std::string_view word(line.begin(), std::ranges::find_if(line, is_blank));
  line = without_blanks_around(line.substr(word.size()));
  return word;
}

class HeaderReader {
 public:
  HeaderReader(PlyInput& input, const std::string& path)
      : input_(input), path_(path), room_(path) {}

  PlyHeader read() {
    read_magic();
    for (;;) {
      next_line();
      std::string_view rest = line_;
      const std::string_view keyword = take_word(rest);
      if (keyword == "end_header") break;
      read_statement(keyword, rest);
    }
    if (!has_format_) refuse("found the end of the header before its format line");
    return std::move(header_);
  }

 private:
  [[noreturn]] void refuse(const std::string& found) const {
    throw Error(ErrorKind::kInput, path_, line_number_,
                found + "; mend the header or export the model again");
  }

  void next_line() {
    line_number_ = input_.line();
    if (!input_.next_line(line_, kMaxLineBytes)) {
      refuse("found the end of the file within the PLY header, expected \"end_header\"");
    }
  }

  void read_magic() {
    const char* const magic = input_.bytes(3);
    const bool begins_so = magic != nullptr && std::string_view(magic, 3) == "ply";
    if (begins_so) next_line();
    if (begins_so && without_blanks_around(line_) == "ply") return;
    throw Error(ErrorKind::kInput, path_, 0,
                "found no PLY file: its first line must be \"ply\"; give a PLY model");
  }

  void read_statement(std::string_view keyword, std::string_view rest) {
    if (keyword == "comment") return read_comment(rest);
    if (keyword == "obj_info" || keyword.empty()) return;
    if (keyword == "format") return read_format(rest);
    if (keyword == "element") return read_element(rest);
    if (keyword == "property") return read_property(rest);
    refuse(
        fmt::format("found \"{}\" in the PLY header, expected format, element, property, "
                    "comment, obj_info or end_header",
                    keyword));
  }

  void read_comment(std::string_view rest) {
    if (take_word(rest) != "TextureFile" || rest.empty()) return;
    if (line_.size() == kMaxLineBytes) refuse("found the name of a texture that is too long");
    room_.add(rest.size());
    std::string name(rest);
    std::ranges::replace(name, '\\', '/');
    header_.texture_files.push_back(std::move(name));
  }

  void read_format(std::string_view rest) {
    const std::string_view format = take_word(rest);
    if (format == "ascii") {
      header_.format = PlyFormat::kAscii;
    } else if (format == "binary_little_endian") {
      header_.format = PlyFormat::kLittleEndian;
    } else if (format == "binary_big_endian") {
      header_.format = PlyFormat::kBigEndian;
    } else {
      refuse(
          fmt::format("found PLY format \"{}\", expected ascii, binary_little_endian or "
                      "binary_big_endian",
                      format));
    }
    if (rest != "1.0") refuse(fmt::format("found PLY version \"{}\", expected 1.0", rest));
    has_format_ = true;
  }

  void read_element(std::string_view rest) {
    const std::string_view name = take_word(rest);
    std::uint64_t count = 0;
    const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), count);
    if (name.empty() || error != std::errc() || end != rest.data() + rest.size()) {
      refuse(fmt::format("found \"{}\" where an element's name and number are expected", line_));
    }
    if (header_.find(name) != nullptr) refuse(fmt::format("found element \"{}\" twice", name));
    count_name(name);
    header_.elements.push_back({std::string(name), count, {}, line_number_});
  }

  void read_property(std::string_view rest) {
    if (header_.elements.empty()) refuse("found a property before the first element");
    PlyProperty property{};
    std::string_view type = take_word(rest);
    if (type == "list") {
      property.count_type = type_named(take_word(rest));
      if (!is_integer(*property.count_type)) refuse("found a list whose length is no integer");
      type = take_word(rest);
    }
    property.type = type_named(type);
    property.name = take_word(rest);
    if (property.name.empty() || !rest.empty()) {
      refuse(fmt::format("found \"{}\" where a property's type and name are expected", line_));
    }
    count_name(property.name);
    header_.elements.back().properties.push_back(std::move(property));
  }

  PlyType type_named(std::string_view name) const {
    const auto* const found = std::ranges::find(kTypeNames, name, &TypeName::name);
    if (found == kTypeNames.end()) {
      refuse(
          fmt::format("found \"{}\" where a PLY type is expected (char, uchar, short, ushort, "
                      "int, uint, float, double)",
                      name));
    }
    return found->type;
  }

  /// Elements and properties both.
  void count_name(std::string_view name) {
    room_.add(name.size());
    if (++names_ > kMaxProperties) {
      refuse(fmt::format("found more than {} elements and properties", kMaxProperties));
    }
  }

  PlyInput& input_;
  const std::string& path_;
  NameRoom room_;
  PlyHeader header_;
  std::string line_;
  std::uint64_t line_number_ = 1;
  std::size_t names_ = 0;
  bool has_format_ = false;
};

}  // namespace

std::size_t bytes_of(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat32:
      return 4;
    case PlyType::kFloat64:
      return 8;
  }
  return 0;
}

bool is_integer(PlyType type) {
  return type != PlyType::kFloat32 && type != PlyType::kFloat64;
}

std::optional<std::size_t> PlyElement::find(std::initializer_list<std::string_view> names,
                                            bool is_list) const {
  for (const std::string_view wanted : names) {
    for (std::size_t i = 0; i < properties.size(); ++i) {
      if (properties[i].name == wanted && properties[i].is_list() == is_list) return i;
    }
  }
  return std::nullopt;
}

const PlyElement* PlyHeader::find(std::string_view name) const {
  const auto found = std::ranges::find(elements, name, &PlyElement::name);
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader read_ply_header(PlyInput& input, const std::string& path) {
  return HeaderReader(input, path).read();
}

}  // namespace atlasgauge
