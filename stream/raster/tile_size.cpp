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
  std::uint64_t bytes = TexelTile::memory_bytes(side, side);
  while (side > 1) {
    side = (side + 1) / 2;
    bytes += TexelTile::memory_bytes(side, side);
  }
  return bytes;
}

std::uint64_t worker_tiles_bytes(std::int64_t side) {
  return 2 * pyramid_bytes(side);
}

std::int64_t choose_tile_size(std::uint64_t free_bytes, std::size_t workers, std::int64_t most) {
  const std::uint64_t bytes = free_bytes / kTileShare / workers;
  const auto largest = static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(most)));
  std::int64_t size = kSmallestTile;
  while (2 * size <= largest && worker_tiles_bytes(2 * size) <= bytes) size *= 2;
  return size;
}

}  // namespace atlasgauge
