#include "measures/output/seam_color.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace atlasgauge {
namespace {

struct Stop {
  double discrepancy;
  Rgb color;
};

/// Doubling from stop to stop keeps small differences apart and still has room for large ones.
constexpr std::array<Stop, 5> kStops{{{0, {0, 0, 128}},
                                      {8, {0, 192, 224}},
                                      {16, {0, 176, 0}},
                                      {32, {255, 224, 0}},
                                      {64, {224, 0, 0}}}};
constexpr Rgb kGrey{128, 128, 128};

std::uint8_t mix(std::uint8_t a, std::uint8_t b, double of_b) {
  return static_cast<std::uint8_t>(std::lround(a + (b - a) * of_b));
}

}  // namespace

Rgb seam_color(double discrepancy) {
  if (std::isnan(discrepancy)) return kGrey;
  const auto above = std::ranges::upper_bound(kStops, discrepancy, {}, &Stop::discrepancy);
  if (above == kStops.begin()) return kStops.front().color;
  if (above == kStops.end()) return kStops.back().color;
  const Stop& low = *(above - 1);
  const double part = (discrepancy - low.discrepancy) / (above->discrepancy - low.discrepancy);
  return {mix(low.color.red, above->color.red, part),
          mix(low.color.green, above->color.green, part),
          mix(low.color.blue, above->color.blue, part)};
}

}  // namespace atlasgauge
