#pragma once

#include <cstdint>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/engine/labels.hpp"
#include "stream/mesh/records.hpp"
#include "stream/raster/atlas_regions.hpp"
#include "stream/raster/region_triangle.hpp"

namespace atlasgauge {

/// All triangles that are drawn, by the regions that they may touch.
struct RegionBins {
  KeyedGroups<RegionTriangle>::Buckets buckets;
  std::vector<std::uint32_t> triangles;  ///< by slot: those that touch any region of it
};

/// Distributes the faces, which `charts` labels in the same order. `drawing_bytes` of the memory
/// that is free now will not be there when the bins are read.
RegionBins distribute_to_regions(const Engine& engine, Spill<Label>& charts,
                                 Spill<AtlasFace>& faces, bool keep_faces,
                                 const AtlasRegions& regions, std::uint64_t drawing_bytes,
                                 StageLog::Stage& stage);

}  // namespace atlasgauge
