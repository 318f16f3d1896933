#include "tests/support/procedural_images.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <memory>
#include <optional>

#include "io/error.hpp"

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
  for (const char c : text) seed = scrambled(seed ^ static_cast<unsigned char>(c));
  return seed;
}

/// From 0 to 1, exclusive.
double unit_of(std::uint64_t hash) {
  return static_cast<double>(hash >> 11) * 0x1p-53;
}

enum class Pattern : std::uint8_t { kNoise, kSlopes, kOneColour };

/// What the name of an image makes of it.
struct Style {
  std::uint64_t hash;
  TexelKind kind;
  Pattern pattern;
  bool broken;
};

Style style_of(std::uint64_t seed, const std::string& file_name) {
  const std::uint64_t hash = hash_of(seed, file_name);
  constexpr std::array kinds = {TexelKind::kByte, TexelKind::kByte, TexelKind::kShort,
                                TexelKind::kFloat};
  constexpr std::array patterns = {Pattern::kNoise, Pattern::kNoise, Pattern::kSlopes,
                                   Pattern::kSlopes, Pattern::kOneColour};
  return {hash, kinds[scrambled(hash) % kinds.size()],
          patterns[scrambled(hash + 1) % patterns.size()], scrambled(hash + 2) % 8 == 0};
}

/// A triangle wave between 0 and 1, some texels long.
double wave(std::uint64_t hash, std::uint32_t column, std::uint32_t row) {
  const double x = unit_of(hash) + column * unit_of(scrambled(hash)) / 4 +
                   row * unit_of(scrambled(hash + 1)) / 4;
  return std::abs(2 * (x - std::floor(x)) - 1);
}

double component(const Style& style, std::size_t channel, std::uint32_t column, std::uint32_t row) {
  const std::uint64_t hash = scrambled(style.hash ^ channel << 32);
  switch (style.pattern) {
    case Pattern::kNoise:
      return unit_of(scrambled(hash ^ (std::uint64_t{row} << 32 | column)));
    case Pattern::kSlopes:
      return wave(hash, column, row);
    case Pattern::kOneColour:
      break;
  }
  return unit_of(hash);
}

template <class Value>
std::byte* put(Value value, std::byte* to) {
  std::memcpy(to, &value, sizeof value);
  return to + sizeof value;
}

/// Floats go beyond their nominal range of 0 to 1.
std::byte* put_component(TexelKind kind, double unit, std::byte* to) {
  switch (kind) {
    case TexelKind::kByte:
      return put(static_cast<std::uint8_t>(unit * 255.99), to);
    case TexelKind::kShort:
      return put(static_cast<std::uint16_t>(unit * 65535.99), to);
    case TexelKind::kFloat:
      break;
  }
  return put(static_cast<float>(1.5 * unit - 0.25), to);
}

class ProceduralRows : public ImageRows {
 public:
  ProceduralRows(std::string path, const Style& style, const ImageHeader& header)
      : path_(std::move(path)), style_(style), header_(header) {
    if (style.broken) broken_row_ = scrambled(style.hash + 3) % header.size.height;
  }

  const ImageHeader& header() const override { return header_; }

  void read(std::uint32_t rows, std::byte* to) override {
    for (const std::uint32_t end = row_ + rows; row_ < end; ++row_) {
      if (row_ == broken_row_) throw Error(ErrorKind::kInput, path_, 0, "no such row");
      to = put_row(to);
    }
  }

 private:
  std::byte* put_row(std::byte* to) const {
    for (std::uint32_t column = 0; column < header_.size.width; ++column) {
      for (std::size_t channel = 0; channel < 3; ++channel) {
        to = put_component(header_.kind, component(style_, channel, column, row_), to);
      }
    }
    return to;
  }

  std::string path_;
  Style style_;
  ImageHeader header_;
  std::optional<std::uint64_t> broken_row_;
  std::uint32_t row_ = 0;
};

std::string name_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

}  // namespace

ProceduralImages::ProceduralImages(ImageSizes sizes, std::uint64_t seed)
    : sizes_(std::move(sizes)), seed_(seed) {}

ImageProbe ProceduralImages::probe() const {
  return [*this](const std::string& path) {
    const auto found = sizes_.find(name_of(path));
    if (found == sizes_.end()) throw Error(ErrorKind::kInput, path, 0, "missing");
    return ImageHeader{.size = {found->second.first, found->second.second},
                       .kind = style_of(seed_, name_of(path)).kind};
  };
}

OpenImage ProceduralImages::open() const {
  return [probe = probe(), seed = seed_](const std::string& path) -> std::unique_ptr<ImageRows> {
    return std::make_unique<ProceduralRows>(path, style_of(seed, name_of(path)), probe(path));
  };
}

}  // namespace atlasgauge
