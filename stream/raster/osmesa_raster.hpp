#pragma once

#include <cstdint>
#include <memory>

#include "stream/raster/raster.hpp"

namespace atlasgauge {

/// The longest side of a tile that the raster of OSMesa takes, in texels.
inline constexpr std::int64_t kMaxOsmesaTile = 8192;

/// The side that is used where it may be chosen: reading back a larger one is no faster.
inline constexpr std::int64_t kUsualOsmesaTile = 1024;

/// Resident bytes that OSMesa costs a process, and each raster on top: three floats for a texel of
/// the largest tile, the context, and triangles on their way (the most seen were 77 MiB and 40
/// MiB).
inline constexpr std::uint64_t kOsmesaLoadedBytes = std::uint64_t{88} << 20;
constexpr std::uint64_t osmesa_raster_bytes(std::int64_t width, std::int64_t height) {
  return static_cast<std::uint64_t>(width + 2) * static_cast<std::uint64_t>(height + 2) * 12 +
         (std::uint64_t{48} << 20);
}

/// A raster that draws with OSMesa, an OpenGL in software: it shares nothing with the scalar raster
/// but the result. Triangles that reach more than about (16384 - tile side) / 2 texels beyond the
/// tile go to the scalar raster, and the tally says so.
///
/// Loads OSMesa when first called, which then must be before other threads look at the environment:
/// it is told by that to work in the threads of its callers. Throws Error(kInternal) where OSMesa
/// cannot be had.
std::unique_ptr<Raster> make_osmesa_raster();

}  // namespace atlasgauge
