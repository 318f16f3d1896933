#pragma once

#include <cstddef>
#include <cstdint>

namespace atlasgauge {

/// Larger ones only put more of the texels out of the caches: as measured, 2048 takes 1.2 times as
/// long.
inline constexpr std::int64_t kLargestTile = 512;

/// What tiles of all levels of a square texture of so many texels a side need.
std::uint64_t pyramid_bytes(std::int64_t side);

/// What the tiles of one worker need: those of a region of so many texels a side at all its levels,
/// and those of the levels of its slot that fit one tile.
std::uint64_t worker_tiles_bytes(std::int64_t side);

/// The side of tiles, a power of two: the largest of which every worker can have its own in a share
/// of the free memory, but no more than is needed for tiles of `most`.
std::int64_t choose_tile_size(std::uint64_t free_bytes, std::size_t workers, std::int64_t most);

}  // namespace atlasgauge
