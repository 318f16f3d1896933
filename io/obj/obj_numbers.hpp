#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace atlasgauge {

/// Blanks separate the words of a line. '\v' is one: it stands for a line end that a backslash took
/// away.
constexpr bool is_blank(char c) {
  return c == ' ' || (static_cast<unsigned char>(c - '\t') <= '\r' - '\t' && c != '\n');
}

constexpr bool is_word_end(char c) {
  return c == ' ' || static_cast<unsigned char>(c - '\t') <= '\r' - '\t';
}

/// One space is by far the most usual.
inline const char* skip_blanks(const char* text) {
  if (*text == ' ') [[likely]] {
    ++text;
  }
  while (static_cast<unsigned char>(*text) <= ' ' && is_blank(*text)) ++text;
  return text;
}

inline const char* skip_word(const char* text) {
  while (!is_word_end(*text)) ++text;
  return text;
}

inline std::string_view word_at(const char* text) {
  return {text, static_cast<std::size_t>(skip_word(text) - text)};
}

/// Bytes that must be readable, whatever they hold, after the blank or line end behind a number.
inline constexpr std::size_t kReadAheadBytes = 4;

/// The three readers below take the word at `text`, which a blank or a line end must follow, and
/// return its end, or nullptr if it is no number. -0 becomes +0.
const char* read_double(const char* text, double& value);

/// Rounds the decimal text to float once; going through double would round twice.
const char* read_float(const char* text, float& value);

/// One of the indices of a face corner: ends at a word end or at '/'. A value beyond 64 bits is
/// read as the largest one of its sign: no model has so many elements, so it names nothing either
/// way.
const char* read_index(const char* text, std::int64_t& value);

namespace numbers {

/// A decimal number, its point taken out.
struct Decimal {
  std::uint64_t digits;
  std::ptrdiff_t decimals;  ///< digits after the point
  bool negative;
};

/// Above 9 for anything but a digit.
constexpr std::uint32_t digit_of(char c) {
  return static_cast<unsigned char>(c) - std::uint32_t{'0'};
}

/// Appends digits to a value; returns their end. Overflow wraps, so callers count the digits.
template <class Unsigned>
[[gnu::always_inline]] inline const char* append_digits(const char* text, Unsigned& value) {
  for (std::uint32_t digit = digit_of(*text); digit <= 9; digit = digit_of(*++text)) {
    value = value * 10 + digit;
  }
  return text;
}

/// The same, the first four digits at once: faster where there are so many. The multiplications
/// add neighbours: first digits to pairs, then pairs to the whole.
template <class Unsigned>
[[gnu::always_inline]] inline const char* append_many_digits(const char* text, Unsigned& value) {
  static_assert(std::endian::native == std::endian::little);
  std::uint32_t bytes = 0;
  std::memcpy(&bytes, text, sizeof bytes);
  const std::uint32_t below_0 = bytes - 0x30303030;
  const std::uint32_t above_9 = bytes + 0x46464646;
  if (((below_0 | above_9) & 0x80808080) == 0) {
    const std::uint32_t pairs = below_0 * (10 * 256 + 1) >> 8 & 0x00FF00FF;
    const std::uint32_t whole = pairs * (100 * 65536 + 1) >> 16;
    value = value * 10000 + whole;
    text += 4;
  }
  return append_digits(text, value);
}

/// Plain "-123.456" of at most 19 digits, the usual case: they fit 64 bits. Returns nullptr for
/// everything else, numbers or not.
[[gnu::always_inline]] inline const char* read_plain_decimal(const char* text, Decimal& decimal) {
  constexpr std::ptrdiff_t kMostDigits = 19;
  decimal.negative = *text == '-';
  const char* const whole = text + (decimal.negative ? 1 : 0);
  decimal.digits = 0;
  decimal.decimals = 0;
  const char* p = append_digits(whole, decimal.digits);
  std::ptrdiff_t count = p - whole;
  if (*p == '.') {
    const char* const fraction = p + 1;
    p = append_many_digits(fraction, decimal.digits);
    decimal.decimals = p - fraction;
    count += decimal.decimals;
  }
  const bool is_plain = count != 0 && count <= kMostDigits && is_word_end(*p);
  return is_plain ? p : nullptr;
}

inline constexpr std::array<double, 20> kPowersOfTen = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,
                                                        1e7,  1e8,  1e9,  1e10, 1e11, 1e12, 1e13,
                                                        1e14, 1e15, 1e16, 1e17, 1e18, 1e19};

/// Digits below 2^53 and powers of ten up to 10^19 are exact doubles, so one division rounds once.
inline bool is_one_division(const Decimal& decimal) {
  return decimal.digits < (std::uint64_t{1} << 53);
}

inline double divide(const Decimal& decimal) {
  const auto digits = static_cast<double>(static_cast<std::int64_t>(decimal.digits));
  const double magnitude = digits / kPowersOfTen[static_cast<std::size_t>(decimal.decimals)];
  const std::uint64_t sign = std::uint64_t{decimal.negative} << 63;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(magnitude) | sign) + 0.0;
}

/// Rounding a correctly rounded double to float is right unless the double lies half way between
/// two floats: then the decimal may lie on either side of it. Holds for normal floats, which all
/// values of is_one_division() decimals are.
inline bool rounds_once_more(double value) {
  constexpr std::uint64_t kBelowFloat = (std::uint64_t{1} << 29) - 1;
  constexpr std::uint64_t kHalfWay = std::uint64_t{1} << 28;
  return (std::bit_cast<std::uint64_t>(value) & kBelowFloat) != kHalfWay;
}

const char* read_double_slowly(const char* text, double& value);
const char* read_float_slowly(const char* text, float& value);
const char* read_index_slowly(const char* text, std::int64_t& value);

}  // namespace numbers

[[gnu::always_inline]] inline const char* read_double(const char* text, double& value) {
  numbers::Decimal decimal{};
  const char* const end = numbers::read_plain_decimal(text, decimal);
  if (end == nullptr || !numbers::is_one_division(decimal)) {
    return numbers::read_double_slowly(text, value);
  }
  value = numbers::divide(decimal);
  return end;
}

[[gnu::always_inline]] inline const char* read_float(const char* text, float& value) {
  numbers::Decimal decimal{};
  const char* const end = numbers::read_plain_decimal(text, decimal);
  if (end == nullptr || !numbers::is_one_division(decimal)) {
    return numbers::read_float_slowly(text, value);
  }
  const double rounded = numbers::divide(decimal);
  if (!numbers::rounds_once_more(rounded)) return numbers::read_float_slowly(text, value);
  value = static_cast<float>(rounded);
  return end;
}

inline const char* read_index(const char* text, std::int64_t& value) {
  constexpr std::ptrdiff_t kMostDigits = 18;
  const bool negative = *text == '-';
  const char* const begin = text + (negative ? 1 : 0);
  std::uint64_t digits = 0;
  const char* const p = numbers::append_many_digits(begin, digits);
  const std::ptrdiff_t count = p - begin;
  if (count == 0 || count > kMostDigits || (*p != '/' && !is_word_end(*p))) {
    return numbers::read_index_slowly(text, value);
  }
  const auto magnitude = static_cast<std::int64_t>(digits);
  value = negative ? -magnitude : magnitude;
  return p;
}

}  // namespace atlasgauge
