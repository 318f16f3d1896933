#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "io/draco/draco_mesh.hpp"
#include "io/file/byte_range.hpp"
#include "io/gltf/gltf_accessor.hpp"
#include "io/gltf/gltf_buffers.hpp"
#include "io/gltf/gltf_model.hpp"
#include "io/gltf/uv_map.hpp"
#include "io/mesh_batch.hpp"
#include "io/model/affine.hpp"
#include "io/model/mesh_part.hpp"

namespace atlasgauge {

/// A Draco stream in the place of accessors.
struct GltfDracoSource {
  ByteRange stream;
  DracoAttributes attributes;
  DracoHeader header;
};

/// A primitive of triangles, found and checked: whatever can be known without reading values. The
/// same for all nodes that show it.
struct GltfGeometry {
  std::string path;  ///< of the glTF, for messages
  std::string name;  ///< for messages: "primitive 0 of mesh 1"
  GltfMode mode = GltfMode::kTriangles;
  AccessorSource positions;
  std::optional<AccessorSource> texcoords;
  std::optional<AccessorSource> indices;
  std::optional<GltfDracoSource> draco;
  std::optional<std::uint32_t> material;  ///< of the glTF
  UvMap uv_map{UvTransform{}};
};

/// Where a primitive goes.
struct GltfPlace {
  Affine transform;
  MaterialId material = kNone<MaterialId>;
};

/// Why a primitive is not measured, though the glTF is right.
struct GltfRefusal {
  const char* kind;    ///< of the warning
  bool is_unreadable;  ///< there are triangles, but not for us
  std::string text;
};

/// Whether a primitive holds triangles that can be read: nothing if so.
std::optional<GltfRefusal> refusal_of(const GltfModel& model, const GltfBuffers& buffers,
                                      const GltfPrimitive& primitive);

/// Checks a primitive that is not refused. Throws Error(kInput), or Error(kResource) for one with
/// more elements than a model may have.
GltfGeometry find_geometry(const GltfModel& model, GltfBuffers& buffers,
                           const GltfPrimitive& primitive, const std::string& name);

/// `block_bytes` are read at a time.
std::unique_ptr<MeshPart> make_part(std::shared_ptr<const GltfGeometry> geometry,
                                    const GltfPlace& place, std::size_t block_bytes);

}  // namespace atlasgauge
