#include "stream/raster/map_preview.hpp"

#include <algorithm>
#include <array>

namespace atlasgauge {
namespace {

constexpr std::uint32_t kWithinChart = std::uint32_t{1} << 30;
constexpr std::uint32_t kBetweenCharts = std::uint32_t{1} << 31;
/// Texels of a pixel are counted up to here: enough for a majority in any square that matters.
constexpr std::uint32_t kCountMask = kWithinChart - 1;

using Rgb = std::array<std::uint8_t, 3>;
constexpr Rgb kEmpty{255, 255, 255};
constexpr Rgb kOnce{166, 206, 240};
constexpr Rgb kOrange{230, 145, 0};
constexpr Rgb kBlack{0, 0, 0};

std::uint32_t divide_up(std::uint32_t a, std::uint32_t b) {
  return (a + b - 1) / b;
}

}  // namespace

std::uint32_t MapPreview::texels_per_pixel(ImageSize texture) {
  return divide_up(std::max(texture.width, texture.height), kLargestSide);
}

std::uint64_t MapPreview::memory_bytes(ImageSize texture) {
  const std::uint32_t step = texels_per_pixel(texture);
  const std::uint64_t pixels =
      std::uint64_t{divide_up(texture.width, step)} * divide_up(texture.height, step);
  return pixels * (sizeof(std::uint32_t) + sizeof(Rgb));
}

MapPreview::MapPreview(ImageSize texture)
    : texture_(texture),
      step_(texels_per_pixel(texture)),
      size_{divide_up(texture.width, step_), divide_up(texture.height, step_)},
      pixels_(std::size_t{size_.width} * size_.height, 0) {}

void MapPreview::add(const MapTile& tile) {
  const TexelRect& rect = tile.rect();
  const std::int64_t top = static_cast<std::int64_t>(texture_.height) - rect.y1;
  for (std::int64_t row = 0; row < rect.height(); ++row) {
    const auto y = static_cast<std::size_t>((top + row) / step_);
    for (std::int64_t column = 0; column < rect.width(); ++column) {
      const auto at = static_cast<std::size_t>(row * tile.tile_size() + column);
      const float n = tile.count()[at];
      if (n == 0) continue;
      const auto x = static_cast<std::size_t>((rect.x0 + column) / step_);
      std::uint32_t& pixel = pixels_[y * size_.width + x];
      if ((pixel & kCountMask) < kCountMask) ++pixel;
      if (n > 1) pixel |= tile.has_several_charts(at) ? kBetweenCharts : kWithinChart;
    }
  }
}

std::vector<std::uint8_t> MapPreview::rgb() const {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(pixels_.size() * sizeof(Rgb));
  for (std::size_t at = 0; at < pixels_.size(); ++at) {
    const auto x = static_cast<std::uint32_t>(at % size_.width);
    const auto y = static_cast<std::uint32_t>(at / size_.width);
    const std::uint64_t texels = std::uint64_t{std::min(step_, texture_.width - x * step_)} *
                                 std::min(step_, texture_.height - y * step_);
    const std::uint32_t pixel = pixels_[at];
    const bool covered = 2 * std::uint64_t{pixel & kCountMask} >= texels;
    const Rgb& colour = (pixel & kBetweenCharts) != 0 ? kBlack
                        : (pixel & kWithinChart) != 0 ? kOrange
                        : covered                     ? kOnce
                                                      : kEmpty;
    bytes.insert(bytes.end(), colour.begin(), colour.end());
  }
  return bytes;
}

}  // namespace atlasgauge
