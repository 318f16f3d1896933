#include "io/texture/mtl_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

#include "io/error.hpp"
#include "io/file/byte_source.hpp"
#include "io/name_room.hpp"
#include "io/obj/obj_numbers.hpp"
#include "io/obj/obj_statement.hpp"
#include "io/texture/line_reader.hpp"

namespace atlasgauge {
namespace {

/// The least and most arguments of an option of a texture map. Those beyond the least are numbers.
struct MapOption {
  std::string_view name;
  int least;
  int most;
};

constexpr std::array kMapOptions = {
    MapOption{"-blendu", 1, 1}, MapOption{"-blendv", 1, 1},    MapOption{"-cc", 1, 1},
    MapOption{"-clamp", 1, 1},  MapOption{"-boost", 1, 1},     MapOption{"-bm", 1, 1},
    MapOption{"-texres", 1, 1}, MapOption{"-type", 1, 1},      MapOption{"-imfchan", 1, 1},
    MapOption{"-mm", 2, 2},     MapOption{"-o", 1, 3},         MapOption{"-s", 1, 3},
    MapOption{"-t", 1, 3},      MapOption{"-colorspace", 1, 1}};

std::string_view trim_front(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  return text;
}

std::string_view first_word(std::string_view text) {
  return text.substr(0,
                     static_cast<std::size_t>(std::ranges::find_if(text, is_blank) - text.begin()));
}

std::string_view after_first_word(std::string_view text) {
  return trim_front(text.substr(first_word(text).size()));
}

bool is_number(std::string_view word) {
  const std::string terminated = std::string(word).append(1 + kReadAheadBytes, '\n');
  double value = 0;
  return read_double(terminated.data(), value) != nullptr;
}

/// A number that may be the option's or the name is the name if nothing follows.
std::string_view skip_arguments(std::string_view text, const MapOption& option) {
  for (int i = 0; i < option.most; ++i) {
    const std::string_view rest = after_first_word(text);
    if (i >= option.least && (rest.empty() || !is_number(first_word(text)))) break;
    text = rest;
  }
  return text;
}

std::string_view skip_options(std::string_view text) {
  for (;;) {
    const auto* const option = std::ranges::find(kMapOptions, first_word(text), &MapOption::name);
    if (option == kMapOptions.end()) return text;
    text = skip_arguments(after_first_word(text), *option);
  }
}

/// A name in quotes may hold a '#'; what follows the closing quote is dropped.
std::string_view image_name(std::string_view text) {
  text = skip_options(text);
  if (text.starts_with('"') && text.find('"', 1) != std::string_view::npos) {
    return text.substr(1, text.find('"', 1) - 1);
  }
  return without_comment(text);
}

std::string with_slashes(std::string_view name) {
  std::string path(name);
  std::ranges::replace(path, '\\', '/');
  return path;
}

/// Adds what a line says to the materials so far.
void read_statement(std::string_view line, std::vector<Material>& materials, NameRoom& room) {
  const std::string_view text = trim_front(line);
  const std::string_view keyword = first_word(text);
  const std::string_view rest = after_first_word(text);
  if (keyword == "newmtl") {
    const std::string_view name = without_comment(rest);
    room.add(name.size());
    materials.push_back({std::string(name), std::nullopt});
  } else if (keyword == "map_Kd" && !materials.empty()) {
    const std::string_view name = image_name(rest);
    if (name.empty()) return;
    room.add(name.size());
    materials.back().image = with_slashes(name);
  }
}

}  // namespace

std::vector<Material> read_mtl(const std::string& path, Warnings& warnings) {
  const std::unique_ptr<ByteSource> source = open_byte_source(path);
  LineReader lines(*source, kMaxWordBytes);
  NameRoom room(path);
  std::vector<Material> materials;
  while (lines.next()) {
    if (lines.is_cut()) {
      warnings.add("overlong line", path, lines.number(),
                   fmt::format("line ignored: it is longer than {} bytes; is this file an MTL?",
                               kMaxWordBytes));
      continue;
    }
    read_statement(lines.line(), materials, room);
  }
  return materials;
}

std::vector<Material> read_mtl_if_readable(const std::string& path, Warnings& warnings) {
  try {
    return read_mtl(path, warnings);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::kInput) throw;
    warnings.add("library unreadable", path, 0, error.what());
    return {};
  }
}

}  // namespace atlasgauge
