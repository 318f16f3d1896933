#include "io/bytes.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>
#include <limits>
#include <string_view>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

[[noreturn]] void refuse(const std::string& text) {
  throw Error(ErrorKind::kUsage,
              "'" + text +
                  "' is not a size; give a number of bytes, or one with K, M, G or T, "
                  "as in 512M");
}

/// Binary digits that a unit stands for, or -1.
int unit_shift(std::string_view unit) {
  if (unit.empty()) return 0;
  const int at = static_cast<int>(std::string_view("kmgt").find(
      static_cast<char>(std::tolower(static_cast<unsigned char>(unit[0])))));
  const std::string_view rest = unit.substr(1);
  const bool known = rest.empty() || rest == "B" || rest == "iB" || rest == "b" || rest == "ib";
  return at < 0 || !known ? -1 : 10 * (at + 1);
}

}  // namespace

std::uint64_t parse_bytes(const std::string& text) {
  std::uint64_t number = 0;
  const char* end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data(), end, number);
  if (error != std::errc()) refuse(text);
  const int shift = unit_shift(std::string_view(rest, static_cast<std::size_t>(end - rest)));
  if (shift < 0 || number > std::numeric_limits<std::uint64_t>::max() >> shift) refuse(text);
  return number << shift;
}

std::string format_bytes(std::uint64_t bytes) {
  constexpr std::string_view kUnits[] = {"B", "KiB", "MiB", "GiB", "TiB", "PiB", "EiB"};
  auto value = static_cast<double>(bytes);
  std::size_t unit = 0;
  for (; value >= 1024 && unit + 1 < std::size(kUnits); ++unit) value /= 1024;
  return unit == 0 ? fmt::format("{} B", bytes) : fmt::format("{:.1f} {}", value, kUnits[unit]);
}

}  // namespace atlasgauge
