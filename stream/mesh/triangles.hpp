#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "io/texture/texture_slots.hpp"
#include "stream/engine/engine.hpp"
#include "stream/mesh/face_stream.hpp"
#include "stream/mesh/mesh_store.hpp"
#include "stream/mesh/triangle.hpp"
#include "stream/mesh/weld.hpp"

namespace atlasgauge {

/// The slot of a face, by its material.
SlotId slot_of(const TextureSlots& slots, MaterialId material);

/// Sizes and whole-texture UV shifts of all slots. The shift of a slot needs the UVs of all its
/// faces, so it costs a pass of its own, unless all UVs of the file lie in the unit square: then
/// there is none.
SlotFrames frame_slots(const Engine& engine, MeshStore& mesh, Weld& weld,
                       const TextureSlots& slots);

/// As FaceVisitor.
struct TriangleVisitor {
  std::function<void(std::size_t worker, std::span<const Triangle>)> transform;
  std::function<void(std::size_t worker)> commit;
};

/// Runs all faces through a visitor, in batches, and consumes them.
void visit_triangles(const Engine& engine, MeshStore& mesh, Weld& weld, const TextureSlots& slots,
                     const SlotFrames& frames, std::uint64_t memory_bytes, StageLog::Stage& stage,
                     const TriangleVisitor& visitor);

}  // namespace atlasgauge
