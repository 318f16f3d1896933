#pragma once

#include <bit>
#include <cstdint>
#include <utility>

namespace atlasgauge {

/// The finalizer of SplitMix64.
inline std::uint64_t mix(std::uint64_t x) {
  x += 0x9e3779b97f4a7c15U;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9U;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebU;
  return x ^ (x >> 31);
}

/// A random bijection of [0, size): Feistel rounds on an even number of bits, repeated until back
/// inside, which takes four steps on average at most.
class Permutation {
 public:
  Permutation(std::uint64_t size, std::uint64_t seed)
      : size_(size), seed_(seed), half_bits_(static_cast<int>(std::bit_width(size) + 1) / 2) {}

  std::uint64_t operator()(std::uint64_t index) const {
    do {
      index = rounds(index);
    } while (index >= size_);
    return index;
  }

  /// The index that the permutation takes to `image`.
  std::uint64_t inverse(std::uint64_t image) const {
    do {
      image = rounds_back(image);
    } while (image >= size_);
    return image;
  }

 private:
  static constexpr std::uint64_t kRounds = 4;

  std::uint64_t mask() const { return (std::uint64_t{1} << half_bits_) - 1; }
  std::uint64_t scrambled(std::uint64_t low, std::uint64_t round) const {
    return mix(seed_ ^ mix(low * kRounds + round)) & mask();
  }

  std::uint64_t rounds(std::uint64_t index) const {
    std::uint64_t high = index >> half_bits_;
    std::uint64_t low = index & mask();
    for (std::uint64_t round = 0; round < kRounds; ++round) {
      high ^= scrambled(low, round);
      std::swap(high, low);
    }
    return high << half_bits_ | low;
  }

  std::uint64_t rounds_back(std::uint64_t index) const {
    std::uint64_t high = index >> half_bits_;
    std::uint64_t low = index & mask();
    for (std::uint64_t round = kRounds; round-- > 0;) {
      std::swap(high, low);
      high ^= scrambled(low, round);
    }
    return high << half_bits_ | low;
  }

  std::uint64_t size_;
  std::uint64_t seed_;
  int half_bits_;
};

}  // namespace atlasgauge
