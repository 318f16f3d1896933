#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/texture/texture_slots.hpp"
#include "stream/raster/map_tile.hpp"

namespace atlasgauge {

/// A picture of at most 2048 pixels a side of what covers a texture. A pixel stands for a square of
/// texels and shows the gravest that is among them: overlap between charts (black), overlap within
/// a chart (orange); else, by majority, covered once (blue) or empty (white). The colours differ in
/// brightness, and blue from orange for every kind of colour blindness.
class MapPreview {
 public:
  static constexpr std::uint32_t kLargestSide = 2048;

  static std::uint64_t memory_bytes(ImageSize texture);
  explicit MapPreview(ImageSize texture);

  /// Takes a tile of level 0.
  void add(const MapTile& tile);

  ImageSize size() const { return size_; }
  /// Three bytes a pixel, rows from the top down.
  std::vector<std::uint8_t> rgb() const;

 private:
  /// Texels of a side of a pixel.
  static std::uint32_t texels_per_pixel(ImageSize texture);

  ImageSize texture_;
  std::uint32_t step_;
  ImageSize size_;
  std::vector<std::uint32_t> pixels_;  ///< number of covered texels, and flags above
};

}  // namespace atlasgauge
