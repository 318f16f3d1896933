#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "io/texture/texture_slots.hpp"
#include "stream/engine/engine.hpp"
#include "stream/engine/labels.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/records.hpp"
#include "stream/raster/raster.hpp"
#include "stream/raster/tile_size.hpp"

namespace atlasgauge {

/// How to raster.
struct RasterPlan {
  std::function<std::unique_ptr<Raster>()> make;  ///< one a worker
  std::int64_t tile_size = 0;  ///< side of a tile in texels; 0: by the memory there is
  std::int64_t largest_tile = kLargestTile;
  bool keep_faces = false;  ///< else their scratch is given back as they are read
};

/// What the raster did, for those who want to see that it did.
struct RasterWork {
  std::int64_t tile_size = 0;
  std::uint64_t tiles = 0;  ///< drawn; one for all levels of a slot that fit one tile
  RasterTally triangles;    ///< by raster; once for each tile that a triangle may touch
};

struct RasterResults {
  Spill<TextureLevel> levels;  ///< of all slots with a size, by slot and level
  RasterWork work;
};

/// Draws all faces on all mip levels of their slots, and hands out the TextureLevel groups.
/// `charts` labels the faces by chart, `faces` are in the same order.
///
/// Triangles are distributed to bins, one a slot. The levels of a slot that fit one tile are drawn
/// in one pass over its bin, which distributes the triangles to the tiles of the larger levels at
/// the same time; those are drawn one by one. A bin that fits in the memory of a worker is worked
/// on by that worker; a larger one by all workers, each in tiles of its own, which are then merged.
/// So neither a slot nor a tile needs memory for its triangles, and scratch holds those of all
/// slots once, and once a level those of one slot.
RasterResults raster_atlas(const Engine& engine, Spill<Label>& charts, Spill<AtlasFace>& faces,
                           const SlotFrames& frames, const RasterPlan& plan, GroupSinks& sinks);

}  // namespace atlasgauge
