#include "io/json/minified_json.hpp"

namespace atlasgauge {

std::string minified_json(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  constexpr std::string_view kBlanks = " \t\r\n";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  std::string line;
  line.reserve(text.size());
  bool in_string = false;
  bool after_backslash = false;
  for (const char c : text) {
    if (!in_string && kBlanks.find(c) != std::string_view::npos) continue;
    line += c;
    if (c == '"' && !after_backslash) in_string = !in_string;
    after_backslash = in_string && c == '\\' && !after_backslash;
  }
  return line;
}

}  // namespace atlasgauge
