#pragma once

#include <charconv>
#include <optional>
#include <string_view>
#include <system_error>

namespace atlasgauge {

/// The number that a text is, and nothing else: no blanks, no sign of plus, no rest.
template <class Number>
std::optional<Number> parsed_number(std::string_view text) {
  Number number{};
  const char* const end = text.data() + text.size();
  const auto [rest, fault] = std::from_chars(text.data(), end, number);
  if (fault != std::errc() || rest != end) return std::nullopt;
  return number;
}

}  // namespace atlasgauge
