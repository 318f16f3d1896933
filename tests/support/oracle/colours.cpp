#include "tests/support/oracle/colours.hpp"

#include <cmath>

namespace atlasgauge::oracle {
namespace {

int64_t wrapped(int64_t i, int64_t period) {
  const int64_t rest = i % period;
  return rest < 0 ? rest + period : rest;
}

// x from the left, y from the bottom, any number of periods away.
Colour texel_colour(const Slot& slot, int64_t x, int64_t y) {
  const int64_t width = slot.size->first, height = slot.size->second;
  return slot.pixels(wrapped(x, width), height - 1 - wrapped(y, height));
}

Colour mixed(const Colour& a, const Colour& b, double share_of_b) {
  Colour mix;
  for (size_t i = 0; i < 3; ++i) mix[i] = a[i] * (1 - share_of_b) + b[i] * share_of_b;
  return mix;
}

}  // namespace

Colour bilinear(const Slot& slot, const Texel& point) {
  const double x = point[0] - 0.5, y = point[1] - 0.5;
  const auto left = static_cast<int64_t>(std::floor(x)), low = static_cast<int64_t>(std::floor(y));
  const double right_share = x - std::floor(x), high_share = y - std::floor(y);
  const auto row = [&](int64_t row_y) {
    return mixed(texel_colour(slot, left, row_y), texel_colour(slot, left + 1, row_y), right_share);
  };
  return mixed(row(low), row(low + 1), high_share);
}

double colour_distance(const Colour& a, const Colour& b) {
  const double red = a[0] - b[0], green = a[1] - b[1], blue = a[2] - b[2];
  return std::sqrt(red * red + green * green + blue * blue);
}

}  // namespace atlasgauge::oracle
