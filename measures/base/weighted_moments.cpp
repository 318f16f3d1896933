#include "measures/base/weighted_moments.hpp"

#include <cmath>

namespace atlasgauge {

void WeightedMoments::add(double value, double weight) {
  ++count_;
  smallest_ = std::min(smallest_, value);
  largest_ = std::max(largest_, value);
  weight_.add(weight);
  const SplitDouble split_value(value);
  const Product weighted = exact_product(weight, SplitDouble(weight), value, split_value);
  first_.add(weighted);
  second_.add(exact_product(weighted.high, SplitDouble(weighted.high), value, split_value));
  second_.add_error(weighted.low * value);
}

void WeightedMoments::merge(const WeightedMoments& other) {
  count_ += other.count_;
  smallest_ = std::min(smallest_, other.smallest_);
  largest_ = std::max(largest_, other.largest_);
  weight_.merge(other.weight_);
  first_.merge(other.first_);
  second_.merge(other.second_);
}

void WeightedMoments::remove(const WeightedMoments& other, double largest) {
  count_ -= other.count_;
  largest_ = largest;
  weight_.subtract(other.weight_);
  first_.subtract(other.first_);
  second_.subtract(other.second_);
}

double WeightedMoments::mean() const {
  return static_cast<double>(first_.precise() / weight_.precise());
}

double WeightedMoments::rms() const {
  return std::sqrt(static_cast<double>(second_.precise() / weight_.precise()));
}

double WeightedMoments::variance() const {
  const Float128 weight = weight_.precise();
  const Float128 mean = first_.precise() / weight;
  const auto variance = static_cast<double>(second_.precise() / weight - mean * mean);
  return variance < 0 ? 0 : variance;
}

double WeightedMoments::standard_deviation() const {
  return std::sqrt(variance());
}

}  // namespace atlasgauge
