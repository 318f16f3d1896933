#include "io/gltf/gltf_draco_part.hpp"

#include <algorithm>
#include <utility>

#include "io/gltf/gltf_batches.hpp"

namespace atlasgauge {

GltfDracoPart::GltfDracoPart(std::shared_ptr<const GltfGeometry> geometry, const GltfPlace& place,
                             std::size_t block_bytes)
    : geometry_(std::move(geometry)),
      place_(place),
      batch_elements_(std::max<std::size_t>(block_bytes / sizeof(FaceRecord), 1)) {}

PartCounts GltfDracoPart::counts() const {
  PartCounts counts = geometry_->draco->header.counts;
  if (!geometry_->draco->attributes.texcoord_id) counts.texcoords = 0;
  return counts;
}

std::uint64_t GltfDracoPart::memory_bytes() const {
  const GltfDracoSource& draco = *geometry_->draco;
  return draco.header.decoding_bytes + draco.stream.size +
         GltfBatches::memory_bytes(batch_elements_);
}

void GltfDracoPart::load() {
  const GltfDracoSource& draco = *geometry_->draco;
  mesh_ = DracoMesh::decode(read_range(draco.stream), draco.attributes, geometry_->path);
}

void GltfDracoPart::emit(MeshSink& sink, Warnings& warnings) {
  if (!mesh_) load();
  GltfBatches batches(sink, batch_elements_);
  for (std::uint64_t i = 0; i < mesh_->positions(); ++i) {
    batches.add(place_.transform.apply(mesh_->position(i)));
  }
  for (std::uint64_t i = 0; i < mesh_->texcoords(); ++i) {
    const TexCoord texcoord = mesh_->texcoord(i);
    batches.add(geometry_->uv_map.apply(texcoord.u, texcoord.v));
  }
  const bool is_mirrored = place_.transform.determinant() < 0;
  for (std::uint64_t i = 0; i < mesh_->faces(); ++i) {
    FaceRecord face = mesh_->face(i);
    face.material = place_.material;
    if (is_mirrored) {
      std::swap(face.v[1], face.v[2]);
      std::swap(face.t[1], face.t[2]);
    }
    batches.add(face);
  }
  batches.finish(warnings, geometry_->path, geometry_->name);
}

std::optional<Quantization> GltfDracoPart::quantization() const {
  std::optional<Quantization> result = mesh_ ? mesh_->quantization() : std::nullopt;
  if (!result) return std::nullopt;
  result->position_step *= place_.transform.coarsest_scale();
  result->uv_step *= geometry_->uv_map.coarsest_scale();
  return result;
}

}  // namespace atlasgauge
