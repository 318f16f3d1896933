#include "io/gltf/gltf_geometry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <vector>

#include "io/draco/draco_begin.hpp"
#include "io/error.hpp"
#include "io/gltf/gltf_accessor_part.hpp"
#include "io/gltf/gltf_draco_part.hpp"
#include "io/gltf/triangle_assembler.hpp"
#include "io/ids.hpp"

namespace atlasgauge {
namespace {

[[noreturn]] void refuse(const GltfBuffers& buffers, const std::string& text) {
  throw Error(ErrorKind::kInput, buffers.path(), 0, text);
}

bool is_triangles(GltfMode mode) {
  return mode == GltfMode::kTriangles || mode == GltfMode::kTriangleStrip ||
         mode == GltfMode::kTriangleFan;
}

/// The n of TEXCOORD_n that a primitive's texture uses, and its transform.
std::pair<std::uint32_t, UvTransform> texcoord_use(const GltfModel& model,
                                                   const GltfBuffers& buffers,
                                                   const GltfPrimitive& primitive) {
  if (!primitive.material) return {0, {}};
  if (*primitive.material >= model.materials.size()) {
    refuse(buffers, fmt::format("a primitive names material {}, but there are {}",
                                *primitive.material, model.materials.size()));
  }
  const std::optional<GltfColour>& colour = model.materials[*primitive.material].colour;
  if (!colour) return {0, {}};
  return {colour->texcoord, colour->transform};
}

std::optional<std::uint32_t> entry(const std::map<std::uint32_t, std::uint32_t>& by_set,
                                   std::uint32_t set) {
  const auto found = by_set.find(set);
  if (found == by_set.end()) return std::nullopt;
  return found->second;
}

void check_elements(const GltfBuffers& buffers, const char* what, std::uint64_t count) {
  if (count <= kMaxElements) return;
  throw Error(ErrorKind::kResource, buffers.path(), 0,
              fmt::format("found {} {} in a primitive, more than the {} a model may have; split "
                          "the model",
                          count, what, kMaxElements));
}

/// Section 3.7.2.1, and KHR_mesh_quantization.
AccessorSource find_attribute(const GltfModel& model, GltfBuffers& buffers, std::uint32_t accessor,
                              std::uint32_t components, const char* what) {
  AccessorSource source = find_accessor(model, buffers, accessor);
  if (source.components != components || source.type == GltfComponent::kUnsignedInt) {
    refuse(buffers, fmt::format("{} holds {}, expected {} components that are floats or integers "
                                "of 8 or 16 bits",
                                source.name, what, components));
  }
  check_elements(buffers, what, source.count);
  return source;
}

AccessorSource find_indices(const GltfModel& model, GltfBuffers& buffers, std::uint32_t accessor) {
  AccessorSource source = find_accessor(model, buffers, accessor);
  const bool is_index = source.type == GltfComponent::kUnsignedByte ||
                        source.type == GltfComponent::kUnsignedShort ||
                        source.type == GltfComponent::kUnsignedInt;
  if (source.components != 1 || !is_index) {
    refuse(buffers, source.name + " holds indices, expected scalars that are unsigned integers");
  }
  return source;
}

GltfDracoSource find_draco(GltfBuffers& buffers, const GltfDraco& draco,
                           std::uint32_t texcoord_set) {
  GltfDracoSource source;
  source.stream = buffers.view(draco.view, "a Draco stream");
  source.attributes = {draco.position, entry(draco.texcoords, texcoord_set), false};
  source.header = read_draco_begin(source.stream).header;
  if (!draco.position) refuse(buffers, "found a Draco stream without POSITION");
  if (!source.header.is_mesh) {
    refuse(buffers, "found a Draco point cloud in a primitive of triangles, expected a mesh");
  }
  return source;
}

std::vector<std::uint32_t> views_read(const GltfModel& model, const GltfPrimitive& primitive,
                                      std::uint32_t texcoord_set) {
  if (primitive.draco) return {primitive.draco->view};
  std::vector<std::uint32_t> views;
  for (const auto& accessor :
       {primitive.position, primitive.indices, entry(primitive.texcoords, texcoord_set)}) {
    if (!accessor || *accessor >= model.accessors.size()) continue;
    std::ranges::copy(views_of(model.accessors[*accessor]), std::back_inserter(views));
  }
  return views;
}

}  // namespace

std::optional<GltfRefusal> refusal_of(const GltfModel& model, const GltfBuffers& buffers,
                                      const GltfPrimitive& primitive) {
  if (!is_triangles(primitive.mode)) {
    return GltfRefusal{"primitives skipped", false, "it has points or lines, not triangles"};
  }
  if (!primitive.position && !primitive.draco) {
    return GltfRefusal{"primitives skipped", false, "it has no positions"};
  }
  const std::uint32_t set = texcoord_use(model, buffers, primitive).first;
  for (const std::uint32_t view : views_read(model, primitive, set)) {
    if (const std::optional<std::string> extension = buffers.meshopt_of(view)) {
      return GltfRefusal{"primitives unreadable", true,
                         fmt::format("buffer view {} is compressed by {}, which is not read here; "
                                     "convert the model, as with gltf-transform copy",
                                     view, *extension)};
    }
  }
  return std::nullopt;
}

GltfGeometry find_geometry(const GltfModel& model, GltfBuffers& buffers,
                           const GltfPrimitive& primitive, const std::string& name) {
  const auto [set, transform] = texcoord_use(model, buffers, primitive);
  GltfGeometry geometry;
  geometry.path = buffers.path();
  geometry.name = name;
  geometry.mode = primitive.mode;
  geometry.material = primitive.material;
  geometry.uv_map = UvMap(transform);
  if (primitive.draco) {
    geometry.draco = find_draco(buffers, *primitive.draco, set);
    return geometry;
  }
  geometry.positions = find_attribute(model, buffers, *primitive.position, 3, "positions");
  if (const auto texcoords = entry(primitive.texcoords, set)) {
    geometry.texcoords = find_attribute(model, buffers, *texcoords, 2, "texture coordinates");
  }
  if (primitive.indices) geometry.indices = find_indices(model, buffers, *primitive.indices);
  const std::uint64_t corners =
      geometry.indices ? geometry.indices->count : geometry.positions.count;
  check_elements(buffers, "triangles", TriangleAssembler::triangles(geometry.mode, corners));
  return geometry;
}

std::unique_ptr<MeshPart> make_part(std::shared_ptr<const GltfGeometry> geometry,
                                    const GltfPlace& place, std::size_t block_bytes) {
  if (geometry->draco) {
    return std::make_unique<GltfDracoPart>(std::move(geometry), place, block_bytes);
  }
  return std::make_unique<GltfAccessorPart>(std::move(geometry), place, block_bytes);
}

}  // namespace atlasgauge
