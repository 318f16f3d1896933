#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/image/image_reader.hpp"
#include "io/texture/texture_slots.hpp"
#include "io/warnings.hpp"
#include "stream/engine/engine.hpp"
#include "stream/engine/quantiles.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/mesh_store.hpp"
#include "stream/mesh/read_model.hpp"
#include "stream/raster/atlas_maps.hpp"
#include "stream/raster/atlas_raster.hpp"
#include "stream/seams/seam_sampling.hpp"

namespace atlasgauge {

/// Global truths about a model that no group carries.
struct MeshFacts {
  std::string name;  ///< file name, without its folder; of several inputs, the first and how many
  std::uint64_t faces = 0;
  std::uint64_t positions = 0;
  std::uint64_t duplicate_positions = 0;  ///< positions minus distinct positions
  std::uint64_t invalid_polygons = 0;
  std::uint64_t boundary_components = 0;
  BoundingBox box;
  TextureSlots textures;
  std::map<std::string, Distribution> distributions;  ///< by name
  /// By slot and level, for all slots with a size; empty under the 1x1 slot.
  Spill<TextureLevel> texture_levels;
  RasterWork raster;
  AtlasStore atlas;                   ///< empty unless distortions were asked for
  Spill<Position> vertices;           ///< by VertexId
  Spill<TextureSeams> texture_seams;  ///< by slot; of those that have any
  SeamWork seams;
  bool texmetro_seams = false;                   ///< seams were sampled as TexMetro does, too
  std::vector<InputQuantization> quantizations;  ///< of the inputs that quantize anything
};

/// Finds the slots of a model from what its inputs say.
using ResolveTextures = std::function<TextureSlots(std::span<const InputMaterials>)>;

/// What is wanted besides the report.
struct StreamOptions {
  RasterPlan raster;
  std::function<void(const Chart&)> on_chart;  ///< all charts, by number; may be empty
  /// For maps: the quasi-conformal distortion of a face, 0 where it has none. If not empty, the
  /// facts keep what maps are drawn from.
  std::function<double(const Triangle&)> distortion_of;
  OpenParts open_parts = open_no_parts;
  OpenImage open_image = atlasgauge::open_image;
  /// Memory within the limit of the process that the engine leaves to decoders of images.
  std::uint64_t spare_bytes = 0;
  bool texmetro_seams = false;              ///< sample seams as TexMetro does, too
  std::function<void(SeamRows&)> on_seams;  ///< all seam edges; may be empty
};

/// The flow of DESIGN section 3: streams a model through all stages, each of which hands its groups
/// to the sinks.
///
///   read -> weld -> UV shift -> triangles -> edges -> vertex stars -> cracks
///        -> labels: components, boundary, charts -> raster (needs chart numbers) -> seams
///        -> percentiles (the cutoff of s_f needs the occupancy)
MeshFacts stream_model(const Engine& engine, std::span<const std::string> inputs,
                       const StreamOptions& options, Warnings& warnings,
                       const ResolveTextures& resolve_textures, GroupSinks& sinks);

}  // namespace atlasgauge
