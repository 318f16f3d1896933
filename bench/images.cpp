#include "bench/images.hpp"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <bit>
#include <cstddef>
#include <memory>
#include <vector>

#include "bench/permutation.hpp"
#include "io/error.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kChannels = 3;
constexpr int kBandRows = 64;

/// From 0 to 96 and back.
std::uint64_t wave(std::uint64_t at, std::uint64_t period) {
  const std::uint64_t phase = at % period * 192 / period;
  return std::min(phase, 192 - phase);
}

std::vector<std::uint64_t> column_waves(std::uint64_t size) {
  std::vector<std::uint64_t> waves;
  for (std::uint64_t i = 0; i < size; ++i) {
    for (const std::uint64_t period : {size, size / 2, size / 4}) waves.push_back(wave(i, period));
  }
  return waves;
}

std::array<std::uint64_t, kChannels> row_waves(std::uint64_t y, std::uint64_t size,
                                               std::uint64_t image) {
  return {wave(y + 37 * image, size / 2), wave(y + 71 * image, size / 3), wave(y, size)};
}

/// Paints gradients and noise; `noise_of(hash, channel)` is from 0 to 63.
template <class Noise>
PaintRow waves_with(std::uint64_t size, std::uint64_t image, Noise noise_of) {
  return [=, of_columns = column_waves(size)](std::uint64_t y, std::uint8_t* texels) {
    const std::array<std::uint64_t, kChannels> of_row = row_waves(y, size, image);
    for (std::uint64_t i = 0; i < size; ++i) {
      const std::uint64_t hash = mix((image * size + y) * size + i);
      for (std::size_t channel = 0; channel < kChannels; ++channel) {
        const std::size_t at = i * kChannels + channel;
        const std::uint64_t noise = noise_of(hash, channel);
        texels[at] = static_cast<std::uint8_t>(of_row[channel] + of_columns[at] + noise);
      }
    }
  };
}

std::unique_ptr<OIIO::ImageOutput> create(const std::string& path, int size) {
  auto image = OIIO::ImageOutput::create(path);
  if (!image) throw Error(ErrorKind::kResource, path, 0, OIIO::geterror());
  OIIO::ImageSpec spec(size, size, kChannels, OIIO::TypeDesc::UINT8);
  spec.attribute("png:compressionLevel", 1);
  spec.attribute("CompressionQuality", 90);
  if (!image->open(path, spec)) throw Error(ErrorKind::kResource, path, 0, image->geterror());
  return image;
}

}  // namespace

PaintRow waves_and_noise(std::uint64_t size_texels, std::uint64_t image) {
  return waves_with(size_texels, image, [](std::uint64_t hash, std::size_t channel) {
    return (hash >> 5 * channel) % 32;
  });
}

PaintRow photo(std::uint64_t size_texels, std::uint64_t image) {
  return waves_with(size_texels, image, [](std::uint64_t hash, std::size_t channel) {
    const auto grain = static_cast<std::uint64_t>(2 * std::popcount(hash >> 38));
    return grain + (hash >> 3 * channel) % 8;
  });
}

PaintRow one_colour(std::uint64_t size_texels, const std::array<std::uint8_t, 3>& colour) {
  return [=](std::uint64_t, std::uint8_t* texels) {
    for (std::uint64_t i = 0; i < size_texels; ++i) {
      texels = std::copy(colour.begin(), colour.end(), texels);
    }
  };
}

void write_image(const std::string& path, std::uint64_t size_texels, const PaintRow& paint) {
  const int size = static_cast<int>(size_texels);
  const auto image = create(path, size);
  const std::size_t row_bytes = size_texels * kChannels;
  std::vector<std::uint8_t> band(row_bytes * kBandRows);
  for (int begin = 0; begin < size; begin += kBandRows) {
    const int end = std::min(size, begin + kBandRows);
    for (int y = begin; y < end; ++y) {
      paint(static_cast<std::uint64_t>(y),
            band.data() + static_cast<std::size_t>(y - begin) * row_bytes);
    }
    if (!image->write_scanlines(begin, end, 0, OIIO::TypeDesc::UINT8, band.data())) {
      throw Error(ErrorKind::kResource, path, 0, image->geterror());
    }
  }
  if (!image->close()) throw Error(ErrorKind::kResource, path, 0, image->geterror());
}

}  // namespace atlasgauge
