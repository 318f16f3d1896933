#include "measures/base/float_digits.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace atlasgauge {

double double_of_digits(float value) {
  if (!std::isfinite(value)) return value;
  std::array<char, 32> digits;
  const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), value);
  double result = 0;
  std::from_chars(digits.data(), end.ptr, result);
  return result;
}

}  // namespace atlasgauge
