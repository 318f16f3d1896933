#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <string>

#include "io/obj/obj_reader.hpp"
#include "io/texture/texture_slots.hpp"
#include "io/warnings.hpp"
#include "stream/engine/engine.hpp"
#include "stream/engine/quantiles.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/mesh_store.hpp"

namespace atlasgauge {

/// Global truths about a model that no group carries.
struct MeshFacts {
  std::string name;  ///< file name, without its folder
  std::uint64_t faces = 0;
  std::uint64_t positions = 0;
  std::uint64_t duplicate_positions = 0;  ///< positions minus distinct positions
  std::uint64_t invalid_polygons = 0;
  std::uint64_t boundary_components = 0;
  BoundingBox box;
  TextureSlots textures;
  std::map<std::string, Quantiles> quantiles;  ///< by distribution
};

/// Finds the slots of a model from what its OBJ says.
using ResolveTextures = std::function<TextureSlots(const ObjSummary&)>;

/// The flow of DESIGN section 3: streams a model through all stages, each of which hands its groups
/// to the sinks.
///
///   read -> weld -> UV shift -> triangles -> edges -> vertex stars
///        -> labels: components, boundary, charts -> seams -> percentiles
///
/// Not there yet, and where they belong: tile bins and raster after charts (they need chart
/// numbers), then s_f, whose cut-off needs occupancy; texel sampling after seams.
MeshFacts stream_model(const Engine& engine, const std::string& path, Warnings& warnings,
                       const ResolveTextures& resolve_textures, GroupSinks& sinks);

}  // namespace atlasgauge
