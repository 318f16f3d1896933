#pragma once

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string_view>

namespace atlasgauge {

/// Whether a name ends so, in letters of either case; `suffix` is in small ones.
inline bool has_suffix(std::string_view name, std::string_view suffix) {
  if (name.size() < suffix.size()) return false;
  return std::equal(
      suffix.begin(), suffix.end(), name.end() - std::ssize(suffix),
      [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

}  // namespace atlasgauge
