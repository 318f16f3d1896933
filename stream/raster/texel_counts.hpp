#pragma once

#include "stream/groups.hpp"
#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {

/// Counts the texels of a tile, the halo serving as neighbours only. Where several charts cover a
/// texel, it belongs to the one with the highest number.
TexelCounts count_texels(const TexelTile& tile);

}  // namespace atlasgauge
