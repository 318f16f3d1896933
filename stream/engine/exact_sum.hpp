#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

namespace atlasgauge {

/// 113-bit floats, for the few operations at the end of a sum.
__extension__ typedef __float128 Float128;

/// 128 bits, for the many operations on the way there.
__extension__ typedef __int128 Int128Sum;

/// A product as the unevaluated sum of its rounded value and the error.
struct Product {
  double high, low;
};

/// A double cut into two of at most 26 bits, whose products are exact.
struct SplitDouble {
  explicit SplitDouble(double x) {
    const double c = 134217729.0 * x;  // 2^27 + 1
    high = c - (c - x);
    low = x - high;
  }
  double high, low;
};

/// a * b (T. J. Dekker, 1971). Written out, because std::fma is a library call on machines without
/// it.
inline Product exact_product(double a, const SplitDouble& s, double b, const SplitDouble& t) {
  const double product = a * b;
  const double error =
      ((s.high * t.high - product) + s.high * t.low + s.low * t.high) + s.low * t.low;
  return {product, std::isfinite(error) ? error : 0.0};
}

/// A sum of doubles without rounding, so that it does not depend on the order of the terms, and
/// partial sums can be merged. The bits of each term end in 64-bit chunks that overlap by half (the
/// small superaccumulator of R. M. Neal, "Fast exact summation using small and large
/// superaccumulators", 2015); carries are propagated once in a while. Terms mostly have about the
/// same size, so they are first added up in a window: a 128-bit integer, which goes to the chunks
/// when a term does not fit, or might overflow it. About half a kilobyte.
class ExactSum {
 public:
  void add(double term) { add(term, terms_window_); }
  /// Adds a * b, not rounded (unless it underflows).
  void add(const Product& product) {
    add(product.high, terms_window_);
    add(product.low, errors_window_);
  }
  /// Adds a term far smaller than the others.
  void add_error(double term) { add(term, errors_window_); }
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
  /// Additions of less than 2^33 until a chunk might overflow, with a margin.
  static constexpr std::uint32_t kAdditionsPerPropagation = 1 << 20;

  /// Counts units of 2^(place - 1074); place is a multiple of 32.
  struct Window {
    /// A term has 53 bits and is shifted by up to 63; so many of them leave the sign alone.
    static constexpr std::uint32_t kTerms = 1024;
    static constexpr unsigned kShifts = 64;

    Int128Sum sum = 0;
    std::uint32_t place = 0;
    std::uint32_t terms = 0;
  };

  void add(double term, Window& window) {
    const auto bits = std::bit_cast<std::uint64_t>(term);
    const auto exponent = static_cast<std::uint32_t>(bits >> 52 & 0x7FF);
    const std::uint32_t shift = exponent - 1 - window.place;
    const bool normal = exponent - 1 < 0x7FE;
    if (!normal || shift >= Window::kShifts || window.terms == Window::kTerms) {
      return add_outside(term, window);
    }
    const auto mantissa = static_cast<std::int64_t>((bits & kFraction) | (kFraction + 1));
    const std::int64_t sign = static_cast<std::int64_t>(bits) >> 63;  // 0 or -1
    window.sum += static_cast<Int128Sum>((mantissa ^ sign) - sign) << shift;
    ++window.terms;
  }

  static constexpr std::uint64_t kFraction = (std::uint64_t{1} << 52) - 1;

  void add_outside(double term, Window& window);
  void flush(Window& window);
  void note_addition();
  void propagate();
  void carry();
  /// The absolute value, propagated.
  ExactSum magnitude(bool& negative) const;
  /// Chunks up to the highest that is not 0.
  std::size_t used_chunks() const;

  Window terms_window_, errors_window_;
  std::array<std::int64_t, kChunks> chunks_{};
  std::uint32_t additions_ = 0;
  std::uint32_t not_finite_ = 0;
};

}  // namespace atlasgauge
