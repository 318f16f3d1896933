#pragma once

#include <cstdint>

#include "io/ids.hpp"
#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/mesh/mesh_store.hpp"

namespace atlasgauge {

/// Which vertices coincide.
struct Weld {
  std::uint64_t duplicates = 0;  ///< positions minus distinct positions
  /// The smallest coincident vertex of every vertex, in vertex order; empty when none coincide, and
  /// then the raw and the welded level are one.
  Spill<VertexId> welded;

  bool found_any() const { return duplicates > 0; }
};

/// Finds coincident vertices: positions are distributed by hash, and each bucket goes through a
/// hash table of its distinct positions. A bucket with more distinct positions than memory is
/// distributed again by other bits of the hash; one with few distinct positions streams through,
/// however long.
Weld weld_vertices(const Engine& engine, MeshStore& mesh);

/// The last uses of welded vertices: the latest of the vertices that coincide.
LastUses last_faces_of_welded(const Engine& engine, const LastUses& last_faces, const Weld& weld);

}  // namespace atlasgauge
