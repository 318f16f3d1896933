#include "bench/worst/numbering.hpp"

#include <numeric>

namespace atlasgauge {
namespace {

/// The golden section keeps all multiples of the stride far from each other.
std::uint64_t golden_stride(std::uint64_t items) {
  auto stride = static_cast<std::uint64_t>(0.6180339887498949 * static_cast<double>(items));
  while (std::gcd(stride, items) != 1) ++stride;
  return stride;
}

/// By Euclid's algorithm.
std::uint64_t inverse_modulo(std::uint64_t a, std::uint64_t modulus) {
  auto r0 = static_cast<std::int64_t>(modulus), r1 = static_cast<std::int64_t>(a);
  std::int64_t t0 = 0, t1 = 1;
  while (r1 != 0) {
    const std::int64_t q = r0 / r1;
    r0 = std::exchange(r1, r0 - q * r1);
    t0 = std::exchange(t1, t0 - q * t1);
  }
  return static_cast<std::uint64_t>(t0 < 0 ? t0 + static_cast<std::int64_t>(modulus) : t0);
}

}  // namespace

Numbering::Numbering(Kind kind, std::uint64_t items, std::uint64_t seed)
    : kind_(kind), items_(items), shuffle_(items, seed) {
  if (kind != Kind::kStrided) return;
  stride_ = golden_stride(items);
  stride_back_ = inverse_modulo(stride_, items);
}

}  // namespace atlasgauge
