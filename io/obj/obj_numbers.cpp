#include "io/obj/obj_numbers.hpp"

#include <fast_float/fast_float.h>

#include <limits>
#include <optional>
#include <system_error>

namespace atlasgauge::numbers {
namespace {

/// A number without its sign.
struct Unsigned {
  std::string_view text;
  bool negative;
};

Unsigned split_sign(std::string_view word) {
  const bool negative = word.front() == '-';
  const bool has_sign = negative || word.front() == '+';
  return {word.substr(has_sign ? 1 : 0), negative};
}

/// The C runtime of Windows prints "1.#INF", "1.#IND", "1.#QNAN" or "1.#SNAN", then padding zeros
/// and perhaps an exponent of zero: "1.#INF00e+000".
bool is_windows_padding(std::string_view text) {
  return text.find_first_not_of("0eE+") == std::string_view::npos;
}

template <class Real>
std::optional<Real> read_windows_special(std::string_view text) {
  if (text.size() < 3 || text.substr(0, 3) != "1.#") return std::nullopt;
  text.remove_prefix(3);
  for (const std::string_view name : {"INF", "IND", "QNAN", "SNAN"}) {
    if (text.substr(0, name.size()) != name) continue;
    if (!is_windows_padding(text.substr(name.size()))) return std::nullopt;
    return name == "INF" ? std::numeric_limits<Real>::infinity()
                         : std::numeric_limits<Real>::quiet_NaN();
  }
  return std::nullopt;
}

template <class Real>
std::optional<Real> read_magnitude(std::string_view text) {
  if (text.empty() || text.front() == '-') return std::nullopt;
  Real value = 0;
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() || error == std::errc::result_out_of_range;
  if (is_number && end == text.data() + text.size()) return value;
  return read_windows_special<Real>(text);
}

template <class Real>
const char* read_real(const char* text, Real& value) {
  const std::string_view word = word_at(text);
  if (word.empty()) return nullptr;
  const auto [magnitude_text, negative] = split_sign(word);
  const std::optional<Real> magnitude = read_magnitude<Real>(magnitude_text);
  if (!magnitude) return nullptr;
  value = (negative ? -*magnitude : *magnitude) + Real{0};
  return text + word.size();
}

}  // namespace

const char* read_double_slowly(const char* text, double& value) {
  return read_real(text, value);
}

const char* read_float_slowly(const char* text, float& value) {
  return read_real(text, value);
}

const char* read_index_slowly(const char* text, std::int64_t& value) {
  constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
  const bool negative = *text == '-';
  const char* const begin = text + (negative || *text == '+' ? 1 : 0);
  const char* p = begin;
  std::int64_t digits = 0;
  for (; digit_of(*p) <= 9; ++p) {
    const std::int64_t digit = digit_of(*p);
    digits = digits > (kMax - digit) / 10 ? kMax : digits * 10 + digit;
  }
  if (p == begin || (*p != '/' && !is_word_end(*p))) return nullptr;
  value = negative ? -digits : digits;
  return p;
}

}  // namespace atlasgauge::numbers
