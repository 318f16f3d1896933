#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <vector>

#include "stream/mesh/triangle.hpp"
#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {

/// Mip level k of a texture of w x h texels is (w >> k) x (h >> k); these are the levels of which
/// both sides have at least one texel (SPEC section 4).
class MipLevels {
 public:
  MipLevels(std::uint64_t width, std::uint64_t height)
      : width_(static_cast<std::int64_t>(width)), height_(static_cast<std::int64_t>(height)) {}

  std::uint32_t count() const {
    return static_cast<std::uint32_t>(
        std::bit_width(static_cast<std::uint64_t>(std::min(width_, height_))));
  }
  LevelSize size(std::uint32_t level) const { return {width_ >> level, height_ >> level}; }
  /// The first levels.
  std::vector<LevelSize> sizes(std::uint32_t levels) const {
    std::vector<LevelSize> sizes;
    for (std::uint32_t level = 0; level < levels; ++level) sizes.push_back(size(level));
    return sizes;
  }

  /// The first level that fits a tile of so many texels a side; count() if none does.
  std::uint32_t first_within(std::int64_t tile_size) const {
    std::uint32_t level = 0;
    while (level < count() && std::max(size(level).width, size(level).height) > tile_size) ++level;
    return level;
  }

 private:
  std::int64_t width_, height_;
};

inline MipLevels levels_of(const SlotFrame& frame) {
  return {static_cast<std::uint64_t>(frame.width), static_cast<std::uint64_t>(frame.height)};
}

/// The frame of a slot at one of its mip levels.
inline SlotFrame at_level(SlotFrame frame, const LevelSize& size) {
  frame.width = static_cast<double>(size.width);
  frame.height = static_cast<double>(size.height);
  return frame;
}

}  // namespace atlasgauge
