#include "tests/support/random_images.hpp"

#include <array>
#include <cmath>
#include <utility>

namespace atlasgauge {
namespace {

/// The finalizer of SplitMix64.
std::uint64_t scrambled(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EB;
  return x ^ (x >> 31);
}

std::uint64_t hash_of(std::uint64_t seed, const std::string& text) {
  std::uint64_t hash = scrambled(seed);
  for (const char c : text) hash = scrambled(hash ^ static_cast<unsigned char>(c));
  return hash;
}

/// From 0 to 1, exclusive.
double unit_of(std::uint64_t hash) {
  return static_cast<double>(hash >> 11) * 0x1p-53;
}

enum class Pattern : std::uint8_t { kNoise, kSlopes, kOneColour };

double noise(std::uint64_t hash, std::uint32_t column, std::uint32_t row) {
  return unit_of(scrambled(hash ^ (std::uint64_t{row} << 32 | column)));
}

/// A triangle wave of at least four texels.
double slope(std::uint64_t hash, std::uint32_t column, std::uint32_t row) {
  const double x = unit_of(hash) + column * unit_of(scrambled(hash)) / 4 +
                   row * unit_of(scrambled(hash + 1)) / 4;
  return std::abs(2 * (x - std::floor(x)) - 1);
}

double unit_at(Pattern pattern, std::uint64_t hash, std::uint32_t column, std::uint32_t row) {
  switch (pattern) {
    case Pattern::kNoise:
      return noise(hash, column, row);
    case Pattern::kSlopes:
      return slope(hash, column, row);
    case Pattern::kOneColour:
      break;
  }
  return unit_of(hash);
}

/// Floats leave their nominal range.
double value_of(TexelKind kind, double unit) {
  return 255 * (kind == TexelKind::kFloat ? 1.5 * unit - 0.25 : unit);
}

template <class T, std::size_t kCount>
T pick(const std::array<T, kCount>& choices, std::uint64_t hash) {
  return choices[scrambled(hash) % kCount];
}

ComputedImage image_of(std::uint64_t hash, const ImageSize& size) {
  const auto pattern = pick(std::array{Pattern::kNoise, Pattern::kNoise, Pattern::kSlopes,
                                       Pattern::kSlopes, Pattern::kOneColour},
                            hash + 1);
  const auto kind = pick(
      std::array{TexelKind::kByte, TexelKind::kByte, TexelKind::kShort, TexelKind::kFloat}, hash);
  ComputedImage image{.size = size, .kind = kind, .colour = {}};
  image.colour = [=](std::uint32_t column, std::uint32_t row) {
    std::array<double, 3> colour{};
    for (std::size_t i = 0; i < colour.size(); ++i) {
      colour[i] = value_of(kind, unit_at(pattern, scrambled(hash + 10 + i), column, row));
    }
    return colour;
  };
  if (scrambled(hash + 2) % 8 == 0) {
    image.broken_row = static_cast<std::uint32_t>(scrambled(hash + 3) % size.height);
  }
  return image;
}

}  // namespace

ComputedImages random_images(const ImageSizes& sizes, std::uint64_t seed) {
  std::map<std::string, ComputedImage> images;
  for (const auto& [name, size] : sizes) {
    images[name] = image_of(hash_of(seed, name), {size.first, size.second});
  }
  return ComputedImages(std::move(images));
}

}  // namespace atlasgauge
