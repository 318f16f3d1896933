#include "io/json/json_affine.hpp"

#include <cmath>

namespace atlasgauge {

Affine affine_from(const JsonView& matrix) {
  constexpr double kRounding = 1e-6;
  const std::vector<double> numbers = matrix.numbers(16);
  Affine result;
  for (std::size_t column = 0; column < 4; ++column) {
    const double last = numbers[4 * column + 3];
    const double expected = column == 3 ? 1 : 0;
    if (!(std::abs(last - expected) <= kRounding)) {
      matrix.refuse("expected an affine matrix, whose last row is 0 0 0 1");
    }
    for (std::size_t row = 0; row < 3; ++row)
      result.m[3 * column + row] = numbers[4 * column + row];
  }
  return result;
}

}  // namespace atlasgauge
