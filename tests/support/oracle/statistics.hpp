#pragma once

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// Exact sums, and statistics over them, rounded once.
namespace atlasgauge::oracle {

// Sums of doubles that lie within 400 binary orders of magnitude are exact.
using Wide = boost::multiprecision::number<
    boost::multiprecision::cpp_bin_float<512, boost::multiprecision::digit_base_2>,
    boost::multiprecision::et_off>;

struct Sample {
  double value;
  double weight;
};

using Samples = std::vector<Sample>;

double rounded(const Wide& value);

// null over nothing.
nlohmann::json ratio(const Wide& numerator, const Wide& denominator);

Wide exact_sum(const std::vector<double>& values);

// Of at least one sample.
Wide average(const Samples& samples);
Wide mean_square(const Samples& samples, const Wide& pivot);

// Extremes and moments under the keys NAME_*, `nothing` without samples.
void report_moments(nlohmann::json& report, const std::string& name, const Samples& samples,
                    const nlohmann::json& nothing);

// Percentiles, extremes and moments under the keys NAME_*; null without samples.
void report_statistics(nlohmann::json& report, const std::string& name, Samples samples);

}  // namespace atlasgauge::oracle
