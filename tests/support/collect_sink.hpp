#pragma once

#include <cstdint>
#include <vector>

#include "io/mesh_batch.hpp"

namespace atlasgauge {

/// Keeps everything a reader hands out.
class CollectSink : public MeshSink {
 public:
  void add(const MeshBatch& batch) override {
    positions.insert(positions.end(), batch.positions.begin(), batch.positions.end());
    texcoords.insert(texcoords.end(), batch.texcoords.begin(), batch.texcoords.end());
    faces.insert(faces.end(), batch.faces.begin(), batch.faces.end());
    forward.insert(forward.end(), batch.forward.begin(), batch.forward.end());
    invalid_polygons += batch.invalid_polygons;
  }

  /// Drops the forward polygons that name no vertex of the whole model; returns how many.
  std::uint64_t drop_unresolved() {
    std::vector<FaceRecord> kept;
    std::uint64_t dropped = 0;
    std::uint64_t next = 0;
    for (const ForwardPolygon& polygon : forward) {
      if (polygon.max_vertex < positions.size()) continue;
      kept.insert(kept.end(), at(next), at(polygon.first_face));
      next = polygon.first_face + polygon.face_count;
      ++dropped;
    }
    kept.insert(kept.end(), at(next), faces.cend());
    faces = kept;
    forward.clear();
    return dropped;
  }

  std::vector<Position> positions;
  std::vector<TexCoord> texcoords;
  std::vector<FaceRecord> faces;
  std::vector<ForwardPolygon> forward;
  std::uint64_t invalid_polygons = 0;  // those of `forward` are not among them

 private:
  std::vector<FaceRecord>::const_iterator at(std::uint64_t face) const {
    return faces.begin() + static_cast<std::ptrdiff_t>(face);
  }
};

}  // namespace atlasgauge
