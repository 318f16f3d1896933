#include "io/warning_totals.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <system_error>

namespace atlasgauge {
namespace {

constexpr std::string_view kBegin = "warnings: ";
constexpr std::string_view kSeparator = ", ";

std::string_view last_line(std::string_view text) {
  const std::size_t at = text.rfind(kBegin);
  if (at == std::string_view::npos || (at > 0 && text[at - 1] != '\n')) return {};
  const std::string_view rest = text.substr(at + kBegin.size());
  return rest.substr(0, rest.find('\n'));
}

}  // namespace

std::string warnings_line(const WarningTotals& totals) {
  std::string line;
  for (const auto& [kind, count] : totals) {
    if (count == 0) continue;
    line += fmt::format("{}{} {}", line.empty() ? kBegin : kSeparator, count, kind);
  }
  return line.empty() ? line : line + "\n";
}

WarningTotals read_warnings_line(std::string_view text) {
  WarningTotals totals;
  for (std::string_view rest = last_line(text); !rest.empty();) {
    const std::string_view entry = rest.substr(0, rest.find(kSeparator));
    rest.remove_prefix(std::min(rest.size(), entry.size() + kSeparator.size()));
    std::uint64_t count = 0;
    const auto [end, fault] = std::from_chars(entry.data(), entry.data() + entry.size(), count);
    const auto digits = static_cast<std::size_t>(end - entry.data());
    if (fault == std::errc() && digits + 1 < entry.size()) {
      totals[std::string(entry.substr(digits + 1))] += count;
    }
  }
  return totals;
}

}  // namespace atlasgauge
