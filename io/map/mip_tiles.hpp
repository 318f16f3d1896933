#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>

#include "io/texture/texture_slots.hpp"

namespace atlasgauge {

/// The tiles of all mip levels of an image, numbered level by level and row by row.
class MipTiles {
 public:
  MipTiles(ImageSize size, std::uint32_t tile_texels) : size_(size), tile_texels_(tile_texels) {}

  std::uint32_t levels() const {
    return static_cast<std::uint32_t>(std::bit_width(std::max(size_.width, size_.height)));
  }

  ImageSize size_of(std::uint32_t level) const {
    return {std::max(size_.width >> level, 1U), std::max(size_.height >> level, 1U)};
  }

  /// Across and down.
  ImageSize tiles_of(std::uint32_t level) const {
    const ImageSize size = size_of(level);
    return {(size.width - 1) / tile_texels_ + 1, (size.height - 1) / tile_texels_ + 1};
  }

  /// How much of a tile is in the image.
  ImageSize inside_of(std::uint32_t level, std::uint32_t x, std::uint32_t y) const {
    const ImageSize size = size_of(level);
    return {std::min(size.width - x * tile_texels_, tile_texels_),
            std::min(size.height - y * tile_texels_, tile_texels_)};
  }

  bool has(std::uint32_t level, std::uint32_t x, std::uint32_t y) const {
    return level < levels() && x < tiles_of(level).width && y < tiles_of(level).height;
  }

  std::uint64_t number_of(std::uint32_t level, std::uint32_t x, std::uint32_t y) const {
    return count_before(level) + std::uint64_t{tiles_of(level).width} * y + x;
  }

  std::uint64_t count() const { return count_before(levels()); }

 private:
  std::uint64_t count_before(std::uint32_t level) const {
    std::uint64_t tiles = 0;
    for (std::uint32_t i = 0; i < level; ++i) {
      tiles += std::uint64_t{tiles_of(i).width} * tiles_of(i).height;
    }
    return tiles;
  }

  ImageSize size_;
  std::uint32_t tile_texels_;
};

}  // namespace atlasgauge
