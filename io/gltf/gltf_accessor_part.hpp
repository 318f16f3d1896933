#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "io/gltf/gltf_batches.hpp"
#include "io/gltf/gltf_geometry.hpp"
#include "io/gltf/triangle_assembler.hpp"
#include "io/model/mesh_part.hpp"

namespace atlasgauge {

/// A primitive whose values lie in accessors, read in blocks while they are handed out.
class GltfAccessorPart : public MeshPart {
 public:
  GltfAccessorPart(std::shared_ptr<const GltfGeometry> geometry, const GltfPlace& place,
                   std::size_t block_bytes);

  PartCounts counts() const override;
  std::uint64_t memory_bytes() const override;
  /// Finds the faults that emit() could stumble over, unless the file changes.
  void load() override;
  void emit(MeshSink& sink, Warnings& warnings) override;
  /// A step is one of the integer, times 1/largest where that is normalized, times what the
  /// placement (for texture coordinates: the texture transform) stretches an axis most.
  std::optional<Quantization> quantization() const override;

 private:
  void emit_positions(GltfBatches& batches) const;
  void emit_texcoords(GltfBatches& batches) const;
  void emit_faces(GltfBatches& batches) const;
  void feed(std::uint32_t index, TriangleAssembler& triangles, GltfBatches& batches) const;

  std::shared_ptr<const GltfGeometry> geometry_;
  GltfPlace place_;
  std::size_t block_elements_;
};

}  // namespace atlasgauge
