#include "measures/base/statistics.hpp"

namespace atlasgauge {

void report_moments(Report& report, const std::string& prefix, const WeightedMoments& moments) {
  report.set(prefix + "_min", moments.smallest());
  report.set(prefix + "_max", moments.largest());
  report.set(prefix + "_avg", moments.mean());
  report.set(prefix + "_rms", moments.rms());
  report.set(prefix + "_var", moments.variance());
  report.set(prefix + "_stddev", moments.standard_deviation());
}

void report_percentiles(Report& report, const std::string& prefix, const PercentileValues& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    report.set(prefix + "_perc" + std::to_string(Quantiles::kPercents[i]), values[i]);
  }
}

}  // namespace atlasgauge
