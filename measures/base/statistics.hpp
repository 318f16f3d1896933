#pragma once

#include <array>
#include <string>

#include "measures/base/report.hpp"
#include "measures/base/weighted_moments.hpp"
#include "stream/engine/quantiles.hpp"

namespace atlasgauge {

using PercentileValues = std::array<double, Quantiles::kPercents.size()>;

/// prefix_min, _max, _avg, _rms, _var, _stddev.
void report_moments(Report& report, const std::string& prefix, const WeightedMoments& moments);

/// prefix_perc1, _perc10, ... _perc99.
void report_percentiles(Report& report, const std::string& prefix, const PercentileValues& values);

}  // namespace atlasgauge
