#pragma once

#include <array>
#include <string>

#include "measures/base/report.hpp"
#include "measures/base/weighted_moments.hpp"
#include "stream/engine/quantiles.hpp"

namespace atlasgauge {

using PercentileValues = std::array<double, Quantiles::kPercents.size()>;

/// prefix_min, _max, _avg, _rms, _var, _stddev, of the values counted in `unit`.
void report_moments(Report& report, const std::string& prefix, const WeightedMoments& moments,
                    double unit = 1);

/// prefix_perc1, _perc10, ... _perc99.
void report_percentiles(Report& report, const std::string& prefix, const PercentileValues& values);

/// The percentiles of f(value) for a rising function f, or of a falling one with the percentiles
/// from above.
template <class Function>
PercentileValues mapped(PercentileValues values, Function f) {
  for (double& value : values) value = f(value);
  return values;
}

}  // namespace atlasgauge
