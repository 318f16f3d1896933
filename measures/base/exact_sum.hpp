#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace atlasgauge {

/// 113-bit floats, for the few operations at the end of a sum.
__extension__ typedef __float128 Float128;

/// A sum of doubles without rounding, so that it does not depend on the order of the terms, and
/// partial sums can be merged. The bits of each term are added to 64-bit chunks that overlap by
/// half (the small superaccumulator of R. M. Neal, "Fast exact summation using small and large
/// superaccumulators", 2015); carries are propagated once in a while. About half a kilobyte.
class ExactSum {
 public:
  void add(double term);
  /// Adds a * b, not rounded (unless it underflows).
  void add_product(double a, double b);
  /// Adds a * b * c, to twice the precision of a double.
  void add_product(double a, double b, double c);
  void merge(const ExactSum& other);
  void subtract(const ExactSum& other);

  /// Nearest double; NaN if a term was not finite.
  double value() const;
  /// To 113 bits.
  Float128 precise() const;

  template <class Archive>
  void serialize(Archive& archive) {
    propagate();
    archive(chunks_, not_finite_);
  }

 private:
  /// Chunk i counts units of 2^(32 i - 1074).
  static constexpr std::size_t kChunks = 68;
  /// Additions of at most 2^53 until a chunk might overflow, with a margin.
  static constexpr std::uint32_t kTermsPerPropagation = 512;

  void propagate();
  /// The absolute value, propagated.
  ExactSum magnitude(bool& negative) const;
  /// Chunks up to the highest that is not 0.
  std::size_t used_chunks() const;

  std::array<std::int64_t, kChunks> chunks_{};
  std::uint32_t terms_ = 0;
  std::uint32_t not_finite_ = 0;
};

}  // namespace atlasgauge
