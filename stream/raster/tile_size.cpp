#include "stream/raster/tile_size.hpp"

#include <algorithm>
#include <bit>

#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {
namespace {

constexpr std::int64_t kSmallestTile = 16;
constexpr std::uint64_t kTileShare = 4;

}  // namespace

std::uint64_t pyramid_bytes(std::int64_t side) {
  std::uint64_t bytes = 0;
  for (; side > 0; side /= 2) bytes += TexelTile::memory_bytes(side, side);
  return bytes;
}

std::int64_t choose_tile_size(std::uint64_t free_bytes, std::size_t workers,
                              std::int64_t largest_side) {
  const std::uint64_t bytes = free_bytes / kTileShare / workers;
  const auto largest = static_cast<std::int64_t>(
      std::bit_ceil(static_cast<std::uint64_t>(std::min(kLargestTile, largest_side))));
  std::int64_t size = kSmallestTile;
  while (2 * size <= largest && pyramid_bytes(2 * size) <= bytes) size *= 2;
  return size;
}

}  // namespace atlasgauge
