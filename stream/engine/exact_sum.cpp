#include "stream/engine/exact_sum.hpp"

#include <bit>
#include <cmath>
#include <limits>

namespace atlasgauge {
namespace {

__extension__ typedef unsigned __int128 UInt128;

}  // namespace

/// A term that is zero, not finite, subnormal, or not within reach of the window.
void ExactSum::add_outside(double term, Window& window) {
  if (term == 0) return;
  if (!std::isfinite(term)) {
    ++not_finite_;
    return;
  }
  const auto bits = std::bit_cast<std::uint64_t>(term);
  const auto exponent = static_cast<std::uint32_t>(bits >> 52 & 0x7FF);
  if (exponent == 0) {
    const auto size = static_cast<std::int64_t>(bits & kFraction);
    const std::int64_t low = size & 0xFFFFFFFF, high = size >> 32;
    chunks_[0] += term < 0 ? -low : low;
    chunks_[1] += term < 0 ? -high : high;
    return note_addition();
  }
  flush(window);
  // Half of the window's reach lies below this term.
  const std::uint32_t chunk = (exponent - 1) / 32;
  window.place = 32 * (chunk == 0 ? 0 : chunk - 1);
  add(term, window);
}

void ExactSum::flush(Window& window) {
  const std::size_t chunk = window.place / 32;
  for (std::size_t i = 0; i < 3; ++i) {
    chunks_[chunk + i] += static_cast<std::int64_t>(window.sum >> 32 * i & 0xFFFFFFFFU);
  }
  chunks_[chunk + 3] += static_cast<std::int64_t>(window.sum >> 96);
  window.sum = 0;
  window.terms = 0;
  note_addition();
}

void ExactSum::note_addition() {
  if (++additions_ == kAdditionsPerPropagation) carry();
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

/// Afterwards equal sums have equal chunks, and nothing besides.
void ExactSum::propagate() {
  flush(terms_window_);
  flush(errors_window_);
  carry();
}

/// Leaves every chunk but the last in [0, 2^32).
void ExactSum::carry() {
  for (std::size_t i = 0; i + 1 < kChunks; ++i) {
    const std::int64_t carry = chunks_[i] >> 32;
    chunks_[i] -= carry * (std::int64_t{1} << 32);
    chunks_[i + 1] += carry;
  }
  additions_ = 0;
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
