#include "measures/base/statistics.hpp"

namespace atlasgauge {

void report_moments(Report& report, const std::string& prefix, const WeightedMoments& moments,
                    double unit) {
  report.set(prefix + "_min", moments.smallest() / unit);
  report.set(prefix + "_max", moments.largest() / unit);
  report.set(prefix + "_avg", moments.mean() / unit);
  report.set(prefix + "_rms", moments.rms() / unit);
  report.set(prefix + "_var", moments.variance() / unit / unit);
  report.set(prefix + "_stddev", moments.standard_deviation() / unit);
}

void report_percentiles(Report& report, const std::string& prefix, const PercentileValues& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    report.set(prefix + "_perc" + std::to_string(Quantiles::kPercents[i]), values[i]);
  }
}

}  // namespace atlasgauge
