#include "measures/base/exact_sum.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace atlasgauge {
namespace {

__extension__ typedef unsigned __int128 UInt128;

struct Product {
  double high, low;
};

/// a * b as the unevaluated sum of its rounded value and the error (T. J. Dekker, 1971). Written
/// out, because std::fma is a library call on machines without it.
Product exact_product(double a, double b) {
  const auto split = [](double x) {
    const double c = 134217729.0 * x;  // 2^27 + 1
    const double high = c - (c - x);
    return Product{high, x - high};
  };
  const double product = a * b;
  const Product s = split(a), t = split(b);
  const double error =
      ((s.high * t.high - product) + s.high * t.low + s.low * t.high) + s.low * t.low;
  return {product, std::isfinite(error) ? error : 0.0};
}

}  // namespace

void ExactSum::add(double term) {
  const auto bits = std::bit_cast<std::uint64_t>(term);
  const auto exponent = static_cast<unsigned>(bits >> 52 & 0x7FF);
  if (exponent == 0x7FF) {
    ++not_finite_;
    return;
  }
  const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
  const std::uint64_t mantissa = exponent == 0 ? fraction : fraction | std::uint64_t{1} << 52;
  const unsigned place = exponent == 0 ? 0 : exponent - 1;  // of the mantissa's lowest bit
  const std::size_t chunk = place / 32;
  const unsigned shift = place % 32;
  const auto low = static_cast<std::int64_t>(mantissa << shift & 0xFFFFFFFFU);
  const auto high = static_cast<std::int64_t>(mantissa >> (32 - shift));
  const bool negative = bits >> 63 != 0;
  chunks_[chunk] += negative ? -low : low;
  chunks_[chunk + 1] += negative ? -high : high;
  if (++terms_ == kTermsPerPropagation) propagate();
}

void ExactSum::add_product(double a, double b) {
  const Product ab = exact_product(a, b);
  add(ab.high);
  add(ab.low);
}

void ExactSum::add_product(double a, double b, double c) {
  const Product ab = exact_product(a, b);
  const Product abc = exact_product(ab.high, c);
  add(abc.high);
  add(abc.low);
  add(ab.low * c);
}

void ExactSum::merge(const ExactSum& other) {
  ExactSum addend = other;
  addend.propagate();
  propagate();
  for (std::size_t i = 0; i < kChunks; ++i) chunks_[i] += addend.chunks_[i];
  not_finite_ += addend.not_finite_;
  propagate();
}

void ExactSum::subtract(const ExactSum& other) {
  ExactSum subtrahend = other;
  subtrahend.propagate();
  propagate();
  for (std::size_t i = 0; i < kChunks; ++i) chunks_[i] -= subtrahend.chunks_[i];
  not_finite_ -= subtrahend.not_finite_;
  propagate();
}

/// Leaves every chunk but the last in [0, 2^32), so equal sums have equal chunks.
void ExactSum::propagate() {
  for (std::size_t i = 0; i + 1 < kChunks; ++i) {
    const std::int64_t carry = chunks_[i] >> 32;
    chunks_[i] -= carry * (std::int64_t{1} << 32);
    chunks_[i + 1] += carry;
  }
  terms_ = 0;
}

ExactSum ExactSum::magnitude(bool& negative) const {
  ExactSum sum = *this;
  sum.propagate();
  negative = sum.chunks_[kChunks - 1] < 0;
  if (negative) {
    for (std::int64_t& chunk : sum.chunks_) chunk = -chunk;
    sum.propagate();
  }
  return sum;
}

std::size_t ExactSum::used_chunks() const {
  std::size_t top = kChunks;
  while (top > 0 && chunks_[top - 1] == 0) --top;
  return top;
}

/// The top five chunks hold all the bits that a Float128 keeps.
Float128 ExactSum::precise() const {
  if (not_finite_ > 0) return std::numeric_limits<double>::quiet_NaN();
  bool negative = false;
  const ExactSum sum = magnitude(negative);
  const std::size_t top = sum.used_chunks();
  Float128 value = 0;
  for (std::size_t i = top; i > 0 && i + 5 > top; --i) {
    const int place = 32 * static_cast<int>(i - 1) - 1074;
    const Float128 half = std::scalbn(1.0, place / 2);
    value += static_cast<Float128>(sum.chunks_[i - 1]) * half * std::scalbn(1.0, place - place / 2);
  }
  return negative ? -value : value;
}

/// The top three chunks have at least 65 bits; whatever is below only breaks ties, and one bit can
/// stand for it.
double ExactSum::value() const {
  if (not_finite_ > 0) return std::numeric_limits<double>::quiet_NaN();
  bool negative = false;
  const ExactSum sum = magnitude(negative);
  const std::size_t top = sum.used_chunks();
  const std::size_t bottom = top < 3 ? 0 : top - 3;
  UInt128 bits = 0;
  for (std::size_t i = top; i > bottom; --i) {
    bits = bits << 32 | static_cast<UInt128>(sum.chunks_[i - 1]);
  }
  for (std::size_t i = 0; i < bottom; ++i) {
    if (sum.chunks_[i] != 0) bits |= 1;
  }
  const int place = 32 * static_cast<int>(bottom) - 1074;
  const double value = std::scalbn(static_cast<double>(bits), place);
  return negative ? -value : value;
}

}  // namespace atlasgauge
