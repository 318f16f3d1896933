#include "stream/mesh/triangles.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace atlasgauge {
namespace {

bool names_a_vertex_twice(const FaceRecord& face) {
  return face.v[0] == face.v[1] || face.v[1] == face.v[2] || face.v[2] == face.v[0];
}

FaceKind kind_of(const JoinedFace& face) {
  if (names_a_vertex_twice(face.record)) return FaceKind::kDegenerate;
  if (!is_finite(face.p[0]) || !is_finite(face.p[1]) || !is_finite(face.p[2])) {
    return FaceKind::kNonFinite;
  }
  const auto& w = face.welded;
  if (w[0] == w[1] || w[1] == w[2] || w[2] == w[0]) return FaceKind::kWeldedDegenerate;
  return FaceKind::kWhole;
}

void map_to_texels(Triangle& triangle, const SlotFrame& frame) {
  triangle.slot_has_size = frame.has_size;
  triangle.has_uv_triangle = frame.has_size && is_finite(triangle.t[0]) &&
                             is_finite(triangle.t[1]) && is_finite(triangle.t[2]);
  triangle.uv_far = false;
  triangle.area_uv = 0;
  if (!triangle.has_uv_triangle) return;
  for (int k = 0; k < 3; ++k) {
    const Texel texel = frame.texel(triangle.t[k]);
    triangle.texel[k] = texel;
    if (is_far(texel)) triangle.uv_far = true;
  }
  triangle.area_uv = signed_area(triangle.texel[0], triangle.texel[1], triangle.texel[2]);
}

Triangle triangle_of(const JoinedFace& face, FaceId id, SlotId slot, const SlotFrame& frame) {
  Triangle triangle{};
  triangle.face = id;
  triangle.slot = slot;
  triangle.kind = kind_of(face);
  for (int k = 0; k < 3; ++k) {
    triangle.v[k] = face.record.v[k];
    triangle.w[k] = face.welded[k];
    triangle.p[k] = face.p[k];
    triangle.t[k] = face.t[k];
  }
  if (!triangle.at_raw_level()) return triangle;
  triangle.area_3d = triangle_area(face.p[0], face.p[1], face.p[2]);
  map_to_texels(triangle, frame);
  return triangle;
}

/// Shifts a slot by whole textures where the centre of its UVs lies outside the unit square.
void shift(SlotFrame& frame, const UvBox& box) {
  const double center_u = 0.5 * (static_cast<double>(box.low_u) + static_cast<double>(box.high_u));
  const double center_v = 0.5 * (static_cast<double>(box.low_v) + static_cast<double>(box.high_v));
  if (center_u >= 0 && center_u <= 1 && center_v >= 0 && center_v <= 1) return;
  frame.shift_u = -std::floor(static_cast<double>(box.low_u));
  frame.shift_v = -std::floor(static_cast<double>(box.low_v));
}

void shift_frames(const Engine& engine, MeshStore& mesh, Weld& weld, const TextureSlots& slots,
                  std::vector<SlotFrame>& frames) {
  StageLog::Stage stage(engine.log, "uv shift", mesh.faces.size());
  const std::size_t workers = engine.workers.count();
  const Reservation memory =
      engine.budget.reserve((workers + 1) * frames.size() * sizeof(UvBox), "UV boxes of the slots");
  std::vector<std::vector<UvBox>> boxes(workers, std::vector<UvBox>(frames.size()));
  FaceVisitor visitor;
  visitor.transform = [&](std::size_t worker, std::uint64_t, std::span<const JoinedFace> faces) {
    for (const JoinedFace& face : faces) {
      const SlotId slot = slot_of(slots, face.record.material);
      const FaceKind kind = kind_of(face);
      if (slot == kNone<SlotId> || kind == FaceKind::kDegenerate || kind == FaceKind::kNonFinite) {
        continue;
      }
      for (const TexCoord& t : face.t) {
        if (is_finite(t)) boxes[worker][raw(slot)].add(t);
      }
    }
  };
  visit_faces(engine, mesh, weld, SpillReader<FaceRecord>::Mode::kKeep,
              engine.budget.free_bytes() / 2, stage, visitor);
  for (std::size_t slot = 0; slot < frames.size(); ++slot) {
    for (std::size_t worker = 1; worker < workers; ++worker) {
      boxes[0][slot].merge(boxes[worker][slot]);
    }
    if (!boxes[0][slot].empty) shift(frames[slot], boxes[0][slot]);
  }
}

}  // namespace

SlotId slot_of(const TextureSlots& slots, MaterialId material) {
  return material == kNone<MaterialId> ? slots.without_material : slots.of_material[raw(material)];
}

SlotFrames frame_slots(const Engine& engine, MeshStore& mesh, Weld& weld,
                       const TextureSlots& slots) {
  std::vector<SlotFrame> frames;
  frames.reserve(slots.slots.size());
  for (const TextureSlot& slot : slots.slots) {
    SlotFrame& frame = frames.emplace_back();
    frame.readable = slot.readable;
    frame.has_size = slot.size.has_value();
    if (!frame.has_size) continue;
    frame.width = slot.size->width;
    frame.height = slot.size->height;
  }
  if (!mesh.uvs_in_unit_square) shift_frames(engine, mesh, weld, slots, frames);
  return SlotFrames(std::move(frames));
}

void visit_triangles(const Engine& engine, MeshStore& mesh, Weld& weld, const TextureSlots& slots,
                     const SlotFrames& frames, std::uint64_t memory_bytes, StageLog::Stage& stage,
                     const TriangleVisitor& visitor) {
  std::vector<std::vector<Triangle>> batches(engine.workers.count());
  FaceVisitor faces;
  faces.transform = [&](std::size_t worker, std::uint64_t first_face,
                        std::span<const JoinedFace> joined) {
    std::vector<Triangle>& batch = batches[worker];
    batch.clear();
    for (const JoinedFace& face : joined) {
      const SlotId slot = slot_of(slots, face.record.material);
      const auto id = static_cast<FaceId>(first_face + batch.size());
      batch.push_back(triangle_of(face, id, slot, frames.of(slot)));
    }
    visitor.transform(worker, batch);
  };
  faces.commit = visitor.commit;
  visit_faces(engine, mesh, weld, SpillReader<FaceRecord>::Mode::kConsume, memory_bytes, stage,
              faces);
}

}  // namespace atlasgauge
