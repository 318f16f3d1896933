#pragma once

#include <optional>

#include "stream/engine/exact_sum.hpp"

namespace atlasgauge {

/// A sum of two doubles, rounded, and what rounding took from it. The error is exact (D. E. Knuth),
/// and NaN where the sum is not finite.
struct RoundedSum {
  RoundedSum(double a, double b) : sum(a + b) {
    const double b_in_sum = sum - a;
    error = (a - (sum - b_in_sum)) + (b - b_in_sum);
  }
  double sum, error;
};

/// A sum of doubles, exact in two of them: enough for a million terms whose sizes differ by a
/// factor of up to 2^30 or so.
class PairSum {
 public:
  PairSum() = default;
  /// Any value, even one that is not finite.
  explicit PairSum(double term) : high_(term) {}

  /// False where the pair has no room for the exact sum; it is unchanged then.
  bool add(double term) {
    const RoundedSum high(high_, term);
    const RoundedSum low(low_, high.error);
    if (low.error != 0) return false;  // as NaN does
    high_ = high.sum;
    low_ = low.sum;
    return true;
  }

  double high() const { return high_; }
  double low() const { return low_; }
  /// The nearest double.
  double value() const { return high_ + low_; }

 private:
  double high_ = 0, low_ = 0;
};

/// An exact sum of doubles that costs as little as a pair, unless their sizes differ too much.
class QuickSum {
 public:
  void add(double term) {
    if (pair_.add(term)) return;
    if (!rest_) rest_.emplace();
    add_pair(*rest_);
    pair_ = PairSum(term);
  }

  /// The nearest double; NaN if a term was not finite.
  double value() const {
    if (!rest_) return pair_.value();
    ExactSum sum = *rest_;
    add_pair(sum);
    return sum.value();
  }

 private:
  void add_pair(ExactSum& sum) const {
    sum.add(pair_.high());
    sum.add(pair_.low());
  }

  PairSum pair_;
  std::optional<ExactSum> rest_;
};

}  // namespace atlasgauge
