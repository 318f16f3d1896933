#include "io/gltf/gltf_batches.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace atlasgauge {
namespace {

void warn(Warnings& warnings, const char* kind, const std::string& path, std::uint64_t count,
          const std::string& text) {
  if (count == 0) return;
  warnings.add(kind, path, 0, text);
  warnings.count(kind, count - 1);
}

}  // namespace

GltfBatches::GltfBatches(MeshSink& sink, std::size_t batch_elements)
    : sink_(sink), batch_elements_(std::max<std::size_t>(batch_elements, 1)) {}

void GltfBatches::add(const Position& position) {
  positions_.push_back(position);
  ++position_count_;
  if (!is_finite(position)) ++not_finite_;
  flush_if_full(positions_.size());
}

void GltfBatches::add(const TexCoord& texcoord) {
  texcoords_.push_back(texcoord);
  ++texcoord_count_;
  if (!is_finite(texcoord)) ++not_finite_;
  flush_if_full(texcoords_.size());
}

void GltfBatches::add(FaceRecord face) {
  for (const VertexId v : face.v) {
    if (raw(v) >= position_count_) return add_invalid_polygon();
  }
  for (TexCoordId& t : face.t) {
    if (raw(t) >= texcoord_count_) t = kNone<TexCoordId>;
  }
  faces_.push_back(face);
  flush_if_full(faces_.size());
}

void GltfBatches::finish(Warnings& warnings, const std::string& path, const std::string& part) {
  warn(warnings, "faces invalid", path, invalid_,
       fmt::format("{} faces dropped from {}: they name a position that is not there, or have "
                   "fewer than three corners",
                   invalid_, part));
  warn(warnings, "coordinates not finite", path, not_finite_,
       fmt::format("{} positions and texture coordinates of {} are not finite", not_finite_, part));
  const MeshBatch rest{.positions = positions_,
                       .texcoords = texcoords_,
                       .faces = faces_,
                       .invalid_polygons = invalid_};
  sink_.add(rest);
}

std::uint64_t GltfBatches::memory_bytes(std::size_t batch_elements) {
  return std::uint64_t{2} * batch_elements *
         (sizeof(Position) + sizeof(TexCoord) + sizeof(FaceRecord));
}

void GltfBatches::flush_if_full(std::size_t gathered) {
  if (gathered >= batch_elements_) flush();
}

void GltfBatches::flush() {
  sink_.add({.positions = positions_, .texcoords = texcoords_, .faces = faces_});
  positions_.clear();
  texcoords_.clear();
  faces_.clear();
}

}  // namespace atlasgauge
