#include "io/file/uri.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>

#include "io/file/file_path.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kDataScheme = "data:";

bool equals_ignoring_case(std::string_view a, std::string_view b) {
  return std::ranges::equal(
      a, b, [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

/// -1 for what is no digit.
int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return -1;
}

/// -1 for what is no digit of base64 (RFC 4648, that for URLs too).
int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  if (c == '+' || c == '-') return 62;
  if (c == '/' || c == '_') return 63;
  return -1;
}

std::string_view without_padding(std::string_view text) {
  for (int i = 0; i < 2 && text.ends_with('='); ++i) text.remove_suffix(1);
  return text;
}

std::optional<std::string> base64_decoded(std::string_view padded) {
  const std::string_view text = without_padding(padded);
  if (text.size() % 4 == 1) return std::nullopt;
  std::string bytes;
  bytes.reserve(text.size() / 4 * 3 + 2);
  std::uint32_t bits = 0;
  int bit_count = 0;
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit < 0) return std::nullopt;
    bits = (bits << 6 | static_cast<std::uint32_t>(digit)) & 0xFFFF;
    bit_count += 6;
    if (bit_count < 8) continue;
    bit_count -= 8;
    bytes.push_back(static_cast<char>(bits >> bit_count & 0xFF));
  }
  return bytes;
}

/// A single letter before the colon is a drive of Windows.
bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find_first_of(":/?#\\");
  if (colon == std::string_view::npos || colon < 2 || uri[colon] != ':') return false;
  return std::ranges::all_of(uri.substr(0, colon), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '+' || c == '-' || c == '.';
  });
}

}  // namespace

std::string percent_decoded(std::string_view uri) {
  std::string text;
  text.reserve(uri.size());
  for (std::size_t i = 0; i < uri.size(); ++i) {
    const bool has_digits = uri[i] == '%' && i + 2 < uri.size() && hex_digit(uri[i + 1]) >= 0 &&
                            hex_digit(uri[i + 2]) >= 0;
    if (!has_digits) {
      text.push_back(uri[i]);
      continue;
    }
    text.push_back(static_cast<char>(hex_digit(uri[i + 1]) * 16 + hex_digit(uri[i + 2])));
    i += 2;
  }
  return text;
}

bool is_data_uri(std::string_view uri) {
  return equals_ignoring_case(uri.substr(0, kDataScheme.size()), kDataScheme);
}

std::optional<std::string> data_uri_bytes(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (comma == std::string_view::npos) return std::nullopt;
  const std::string_view type = uri.substr(0, comma);
  const std::string_view data = uri.substr(comma + 1);
  constexpr std::string_view kBase64 = ";base64";
  const bool is_base64 = type.size() >= kBase64.size() &&
                         equals_ignoring_case(type.substr(type.size() - kBase64.size()), kBase64);
  if (!is_base64) return percent_decoded(data);
  if (data.find('%') == std::string_view::npos) return base64_decoded(data);
  return base64_decoded(percent_decoded(data));
}

std::optional<fs::path> file_of_uri(std::string_view uri, const fs::path& folder) {
  if (uri.empty() || has_scheme(uri)) return std::nullopt;
  std::string spelled(uri);
  std::ranges::replace(spelled, '\\', '/');
  const std::string without_query = spelled.substr(0, spelled.find_first_of("?#"));
  const std::array names = {percent_decoded(spelled), spelled, percent_decoded(without_query),
                            without_query};
  if (names[0].find('\0') != std::string::npos) return std::nullopt;
  for (const std::string& name : names) {
    if (!name.empty() && is_file(folder / name)) return folder / name;
  }
  return folder / names[0];
}

std::string shown_uri(std::string_view uri) {
  constexpr std::size_t kShownBytes = 80;
  if (uri.size() <= kShownBytes) return std::string(uri);
  return std::string(uri.substr(0, kShownBytes)) + "...";
}

}  // namespace atlasgauge
