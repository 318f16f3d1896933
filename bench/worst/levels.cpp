#include "bench/worst/levels.hpp"

namespace atlasgauge {
namespace {

/// 1 + 2 + ... + n.
std::uint64_t triangular(std::uint64_t n) {
  return n * (n + 1) / 2;
}

std::uint64_t rim_of(std::uint64_t side) {
  return side > 1 ? 4 * (side - 1) : side;
}

}  // namespace

LevelCover whole_cover(std::uint64_t side) {
  return {side * side, side * side, rim_of(side)};
}

LevelCover square_cover(std::uint64_t s) {
  if (s == 0) return {};
  return {s * s, (s + 2) * (s + 2), rim_of(s)};
}

// Covered is x + y <= s - 2. Of those with x + y = s, only the two on the rim have no covered
// neighbour; those without an uncovered one have x, y > 0 and x + y <= s - 4.
LevelCover corner_cover(std::uint64_t s) {
  if (s < 2) return {};
  const std::uint64_t covered = triangular(s - 1);
  const std::uint64_t inner = s > 5 ? triangular(s - 5) : 0;
  return {covered, covered + s + (s - 1), covered - inner};
}

LevelCover diagonal_cover(std::uint64_t side) {
  const std::uint64_t beside = side > 1 ? 2 * (side - 1) + 2 * (side - 2) : 0;
  return {side, side + beside, side};
}

// Covered is x >= y. Those without an uncovered neighbour have x >= y + 2 and are not on the rim.
LevelCover half_cover(std::uint64_t side) {
  const std::uint64_t covered = triangular(side);
  const std::uint64_t beside = side > 1 ? (side - 1) + (side - 2) : 0;
  const std::uint64_t inner = side > 4 ? triangular(side - 4) : 0;
  return {covered, covered + beside, covered - inner};
}

}  // namespace atlasgauge
