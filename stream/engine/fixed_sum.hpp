#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace atlasgauge {

__extension__ typedef __int128 Int128;

/// Doubles as integers, in units of 2^-62 of the largest: sums of them do not depend on their
/// order.
class FixedScale {
 public:
  explicit FixedScale(double largest) : scale_(largest > 0 ? 61 - std::ilogb(largest) : 0) {}
  std::int64_t of(double value) const {
    return static_cast<std::int64_t>(std::llrint(std::scalbn(value, scale_)));
  }
  /// The double nearest to a sum.
  double value(Int128 sum) const { return std::scalbn(static_cast<double>(sum), -scale_); }

 private:
  int scale_;
};

/// A sum of terms that are not negative, which are named twice: first expected, then added.
class FixedSum {
 public:
  void expect(double term) { largest_ = std::max(largest_, term); }
  void add(double term) { sum_ += FixedScale(largest_).of(term); }
  double value() const { return FixedScale(largest_).value(sum_); }

 private:
  double largest_ = 0;
  Int128 sum_ = 0;
};

}  // namespace atlasgauge
