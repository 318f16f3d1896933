#include "stream/mesh/mesh_store.hpp"

#include <algorithm>
#include <utility>

namespace atlasgauge {

void BoundingBox::add(const Position& p) {
  if (std::exchange(empty, false)) {
    low = high = p;
    return;
  }
  low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
  high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
}

double BoundingBox::longest_side() const {
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

void note_last_faces(std::span<const FaceRecord> faces, std::uint64_t before,
                     LastUses& last_faces) {
  auto items = static_cast<std::uint32_t>(before);
  for (const FaceRecord& face : faces) {
    ++items;
    for (const VertexId v : face.v) last_faces.note(raw(v), items);
  }
}

}  // namespace atlasgauge
