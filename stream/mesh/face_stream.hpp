#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "io/mesh_batch.hpp"
#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/mesh/mesh_store.hpp"
#include "stream/mesh/weld.hpp"

namespace atlasgauge {

/// A face joined with what its corners name.
struct JoinedFace {
  FaceRecord record;
  VertexId welded[3];
  Position p[3];
  TexCoord t[3];  ///< kNoTexCoord where the corner has no finite UV
};

/// What to do with the faces; see Workers for who calls what. An item is several batches.
struct FaceVisitor {
  /// Any worker, once a batch; `first_face` is the number of the first of them.
  std::function<void(std::size_t worker, std::uint64_t first_face, std::span<const JoinedFace>)>
      transform;
  /// In face order, once an item.
  std::function<void(std::size_t worker)> commit;
};

/// Runs all faces, joined with their positions and UVs, through a visitor, in the memory the budget
/// has free but at most `memory_bytes`. Bounded for any order of indices:
///   1. tables that fit are read into memory;
///   2. else every worker looks up through page caches: scans are written region by region, and
///      hardly miss;
///   3. when they have read more than gathering would have cost, the corners of the other faces are
///      gathered by two sequential distributions instead. So all costs at most twice what
///      gathering alone does.
/// `mode` says whether the faces are consumed.
void visit_faces(const Engine& engine, MeshStore& mesh, Weld& weld,
                 SpillReader<FaceRecord>::Mode mode, std::uint64_t memory_bytes,
                 StageLog::Stage& stage, const FaceVisitor& visitor);

}  // namespace atlasgauge
