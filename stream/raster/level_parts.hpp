#pragma once

#include <cstdint>
#include <utility>

#include "stream/engine/engine.hpp"
#include "stream/engine/partition.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/triangle.hpp"
#include "stream/raster/tile_pyramid.hpp"

namespace atlasgauge {

/// What was counted in some texels of a level.
struct LevelPart {
  SlotId slot;
  std::uint32_t level;
  TexelCounts counts;

  std::pair<std::uint32_t, std::uint32_t> key() const { return {raw(slot), level}; }
};

using LevelParts = SharedSpill<LevelPart>;

/// Counts the texels of all tiles.
void count_tiles(SlotId slot, const TilePyramid& pyramid, LevelParts::Writer& parts);

/// Adds up the parts of every level; a level that no triangle touched has none.
Spill<TextureLevel> merge_parts(const Engine& engine, Spill<LevelPart> parts,
                                const SlotFrames& frames, GroupSink& sink);

}  // namespace atlasgauge
