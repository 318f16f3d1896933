#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "io/draco/draco_mesh.hpp"
#include "io/gltf/gltf_geometry.hpp"
#include "io/model/mesh_part.hpp"

namespace atlasgauge {

/// A primitive of KHR_draco_mesh_compression: decoded whole by load(). Positions and texture
/// coordinates are the distinct values of the stream, so there may be fewer than the accessors of
/// the glTF promise.
class GltfDracoPart : public MeshPart {
 public:
  GltfDracoPart(std::shared_ptr<const GltfGeometry> geometry, const GltfPlace& place,
                std::size_t block_bytes);

  PartCounts counts() const override;
  std::uint64_t memory_bytes() const override;
  void load() override;
  void emit(MeshSink& sink, Warnings& warnings) override;
  std::optional<Quantization> quantization() const override;

 private:
  std::shared_ptr<const GltfGeometry> geometry_;
  GltfPlace place_;
  std::size_t batch_elements_;
  std::optional<DracoMesh> mesh_;
};

}  // namespace atlasgauge
