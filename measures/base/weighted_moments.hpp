#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "stream/engine/exact_sum.hpp"

namespace atlasgauge {

/// Mean, root mean square, population variance and range of weighted values. The moments about zero
/// are summed to more than 100 bits, so that the variance keeps its digits even where all values
/// are nearly equal.
class WeightedMoments {
 public:
  void add(double value, double weight);
  void merge(const WeightedMoments& other);
  /// Takes back values that were added; `largest` is the largest that is left.
  void remove(const WeightedMoments& other, double largest);

  /// Sum of the weights.
  double weight() const { return weight_.value(); }
  /// NaN where there is no weight.
  double mean() const;
  double rms() const;
  double variance() const;
  double standard_deviation() const;
  /// NaN where there is no value.
  double smallest() const {
    return count_ > 0 ? smallest_ : std::numeric_limits<double>::quiet_NaN();
  }
  double largest() const {
    return count_ > 0 ? largest_ : std::numeric_limits<double>::quiet_NaN();
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(count_, smallest_, largest_, weight_, first_, second_);
  }

 private:
  std::uint64_t count_ = 0;
  double smallest_ = std::numeric_limits<double>::infinity();
  double largest_ = -std::numeric_limits<double>::infinity();
  ExactSum weight_, first_, second_;
};

}  // namespace atlasgauge
