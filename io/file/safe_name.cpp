#include "io/file/safe_name.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace atlasgauge {
namespace {

constexpr std::size_t kMostBytes = 59;  // beside a number of at most 20 digits and a '_'

bool is_safe(char c) {
  return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' ||
         c == '-';
}

/// Without folders and the suffix.
std::string_view stem_of(std::string_view path) {
  path.remove_prefix(path.find_last_of("/\\") + 1);  // none: npos + 1 is 0
  const std::size_t dot = path.rfind('.');
  return dot == std::string_view::npos ? path : path.substr(0, dot);
}

/// A '_' for each run of other characters.
std::string safe_text(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (is_safe(c)) {
      safe += c;
    } else if (!safe.ends_with('_')) {
      safe += '_';
    }
  }
  return safe.substr(0, kMostBytes);
}

}  // namespace

std::string safe_file_name(std::size_t number, std::string_view texture, std::string_view suffix) {
  const std::string name = safe_text(stem_of(texture));
  return fmt::format("{:04}{}{}{}", number, name.empty() ? "" : "_", name, suffix);
}

}  // namespace atlasgauge
