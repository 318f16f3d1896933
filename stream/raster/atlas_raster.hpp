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
  std::uint64_t tiles = 0;  ///< drawn: regions, and one for all levels of a slot drawn whole
  RasterTally triangles;    ///< by raster; once for each level of a tile that it touches
};

struct RasterResults {
  Spill<TextureLevel> levels;  ///< of all slots with a size, by slot and level
  RasterWork work;
};

/// Draws all faces on all mip levels of their slots, and hands out the TextureLevel groups.
/// `charts` labels the faces by chart, `faces` are in the same order.
///
/// Triangles are distributed to regions (atlas_regions.hpp), once for all levels. Regions are drawn
/// one by one, each by one worker if its triangles fit in memory, else by all, each in tiles of its
/// own, which are then merged. With its regions each worker draws those levels of their slot that
/// are in no region, as far as its triangles go. So neither a slot nor a region needs memory for
/// its triangles, and scratch holds those of all slots about once.
RasterResults raster_atlas(const Engine& engine, Spill<Label>& charts, Spill<AtlasFace>& faces,
                           const SlotFrames& frames, const RasterPlan& plan, GroupSinks& sinks);

}  // namespace atlasgauge
