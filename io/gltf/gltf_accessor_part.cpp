#include "io/gltf/gltf_accessor_part.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <utility>

namespace atlasgauge {
namespace {

/// Of an element in the file (with its stride) or of a value made of it, whichever is more.
constexpr std::size_t kMostElementBytes = 256;

std::uint32_t bits_of(const AccessorSource& source) {
  return source.type == GltfComponent::kFloat ? 0 : 8 * component_bytes(source.type);
}

double step_of(const AccessorSource& source) {
  return component_step(source.type, source.normalized);
}

/// Calls use(value) for every element, an array of its N components.
template <std::size_t N, class Use>
void visit_elements(const AccessorSource& source, std::size_t block_elements, Use use) {
  const std::size_t bytes = component_bytes(source.type);
  AccessorBlocks blocks(source, block_elements);
  for (auto block = blocks.next(); !block.empty(); block = blocks.next()) {
    for (std::size_t at = 0; at < block.size(); at += N * bytes) {
      std::array<double, N> value;
      for (std::size_t i = 0; i < N; ++i) {
        value[i] = component_value(&block[at + i * bytes], source.type, source.normalized);
      }
      use(value);
    }
  }
}

}  // namespace

GltfAccessorPart::GltfAccessorPart(std::shared_ptr<const GltfGeometry> geometry,
                                   const GltfPlace& place, std::size_t block_bytes)
    : geometry_(std::move(geometry)),
      place_(place),
      block_elements_(std::max<std::size_t>(block_bytes / kMostElementBytes, 1)) {}

PartCounts GltfAccessorPart::counts() const {
  const std::uint64_t corners =
      geometry_->indices ? geometry_->indices->count : geometry_->positions.count;
  return {geometry_->positions.count, geometry_->texcoords ? geometry_->texcoords->count : 0,
          TriangleAssembler::triangles(geometry_->mode, corners)};
}

/// A block of the file, the same without stride, indices and values that replace some, and a batch.
std::uint64_t GltfAccessorPart::memory_bytes() const {
  return 4 * kMostElementBytes * block_elements_ + GltfBatches::memory_bytes(block_elements_);
}

void GltfAccessorPart::load() {
  check_sparse(geometry_->positions, block_elements_);
  if (geometry_->texcoords) check_sparse(*geometry_->texcoords, block_elements_);
  if (geometry_->indices) check_sparse(*geometry_->indices, block_elements_);
}

void GltfAccessorPart::emit(MeshSink& sink, Warnings& warnings) {
  GltfBatches batches(sink, block_elements_);
  emit_positions(batches);
  if (geometry_->texcoords) emit_texcoords(batches);
  emit_faces(batches);
  batches.finish(warnings, geometry_->path, geometry_->name);
}

std::optional<Quantization> GltfAccessorPart::quantization() const {
  Quantization result;
  result.position_bits = bits_of(geometry_->positions);
  result.position_step = step_of(geometry_->positions) * place_.transform.coarsest_scale();
  if (geometry_->texcoords) {
    result.uv_bits = bits_of(*geometry_->texcoords);
    result.uv_step = step_of(*geometry_->texcoords) * geometry_->uv_map.coarsest_scale();
  }
  if (result.position_bits == 0 && result.uv_bits == 0) return std::nullopt;
  return result;
}

void GltfAccessorPart::emit_positions(GltfBatches& batches) const {
  visit_elements<3>(geometry_->positions, block_elements_, [&](const auto& p) {
    batches.add(place_.transform.apply({p[0], p[1], p[2]}));
  });
}

void GltfAccessorPart::emit_texcoords(GltfBatches& batches) const {
  visit_elements<2>(*geometry_->texcoords, block_elements_,
                    [&](const auto& t) { batches.add(geometry_->uv_map.apply(t[0], t[1])); });
}

void GltfAccessorPart::emit_faces(GltfBatches& batches) const {
  TriangleAssembler triangles(geometry_->mode, place_.transform.determinant() < 0);
  if (geometry_->indices) {
    const GltfComponent type = geometry_->indices->type;
    AccessorBlocks blocks(*geometry_->indices, block_elements_);
    for (auto block = blocks.next(); !block.empty(); block = blocks.next()) {
      for (std::size_t at = 0; at < block.size(); at += component_bytes(type)) {
        feed(index_value(&block[at], type), triangles, batches);
      }
    }
  } else {
    const auto corners = static_cast<std::uint32_t>(geometry_->positions.count);
    for (std::uint32_t index = 0; index < corners; ++index) feed(index, triangles, batches);
  }
  if (triangles.has_rest()) batches.add_invalid_polygon();
}

/// A texture coordinate has the number of its position.
void GltfAccessorPart::feed(std::uint32_t index, TriangleAssembler& triangles,
                            GltfBatches& batches) const {
  if (!triangles.feed(index)) return;
  const auto& [a, b, c] = triangles.corners();
  batches.add(FaceRecord{{VertexId{a}, VertexId{b}, VertexId{c}},
                         {TexCoordId{a}, TexCoordId{b}, TexCoordId{c}},
                         place_.material});
}

}  // namespace atlasgauge
