#include "tests/support/oracle/statistics.hpp"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace atlasgauge::oracle {

using nlohmann::json;

namespace {

Wide weighted_sum(const Samples& samples, const std::function<Wide(const Wide&)>& of) {
  Wide sum = 0;
  for (const Sample& sample : samples) sum += of(Wide(sample.value)) * Wide(sample.weight);
  return sum;
}

// The smallest value whose cumulative weight reaches that share of the total; samples are sorted.
double percentile(const Samples& sorted, int percent, const Wide& total) {
  Wide cumulative = 0;
  for (const Sample& sample : sorted) {
    cumulative += sample.weight;
    if (cumulative * 100 >= total * percent) return sample.value;
  }
  return sorted.back().value;
}

constexpr std::array<int, 11> kPercents = {1, 10, 20, 30, 40, 50, 60, 70, 80, 90, 99};

}  // namespace

double rounded(const Wide& value) {
  return value.convert_to<double>();
}

json ratio(const Wide& numerator, const Wide& denominator) {
  if (denominator == 0) return nullptr;
  return rounded(numerator / denominator);
}

Wide exact_sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), Wide(0));
}

Wide total_weight(const Samples& samples) {
  return weighted_sum(samples, [](const Wide&) { return Wide(1); });
}

Wide average(const Samples& samples) {
  return weighted_sum(samples, [](const Wide& x) { return x; }) / total_weight(samples);
}

Wide mean_square(const Samples& samples, const Wide& pivot) {
  const auto square = [&](const Wide& x) { return Wide((x - pivot) * (x - pivot)); };
  return weighted_sum(samples, square) / total_weight(samples);
}

void report_moments(json& report, const std::string& name, const Samples& samples,
                    const json& nothing) {
  for (const char* suffix : {"_min", "_max", "_avg", "_rms", "_var", "_stddev"}) {
    report[name + suffix] = nothing;
  }
  if (samples.empty()) return;
  const auto [least, most] =
      std::minmax_element(samples.begin(), samples.end(),
                          [](const Sample& a, const Sample& b) { return a.value < b.value; });
  const Wide mean = average(samples);
  const Wide variance = mean_square(samples, mean);
  report[name + "_min"] = least->value;
  report[name + "_max"] = most->value;
  report[name + "_avg"] = rounded(mean);
  report[name + "_rms"] = rounded(sqrt(mean_square(samples, 0)));
  report[name + "_var"] = rounded(variance);
  report[name + "_stddev"] = rounded(sqrt(variance));
}

void report_statistics(json& report, const std::string& name, Samples samples) {
  std::sort(samples.begin(), samples.end(),
            [](const Sample& a, const Sample& b) { return a.value < b.value; });
  const Wide total = total_weight(samples);
  for (const int percent : kPercents) {
    json& value = report[name + "_perc" + std::to_string(percent)];
    value = samples.empty() ? json(nullptr) : json(percentile(samples, percent, total));
  }
  report_moments(report, name, samples, nullptr);
}

}  // namespace atlasgauge::oracle
