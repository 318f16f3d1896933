#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "stream/engine/engine.hpp"
#include "stream/engine/labels.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/records.hpp"
#include "stream/mesh/triangle.hpp"

namespace atlasgauge {

/// What the edges tell later stages.
struct EdgeResults {
  Spill<Link> raw_links;       ///< faces that share a raw edge
  Spill<Link> uv_links;        ///< faces that share a uv edge
  Spill<Link> boundary_links;  ///< the two vertices of every raw boundary edge
  Spill<SeamCandidate> seams;
  Spill<BorderEdge> borders;  ///< uv boundary edges; empty unless they were to be kept
  bool raw_manifold = true;   ///< no raw edge has more than two faces
  bool uv_manifold = true;    ///< no uv edge has more than two faces
};

/// The edge table. Every face emits three half-edges, distributed by their lower welded vertex; one
/// grouping serves all three levels, since raw and uv edges nest inside welded ones. Faces on one
/// edge are linked in a chain, not all with all.
class EdgeTable {
 public:
  virtual ~EdgeTable() = default;

  /// `welded`: some vertices coincide. `memory_bytes` is what distribution may take.
  static std::unique_ptr<EdgeTable> make(const Engine& engine, bool welded, std::uint64_t faces,
                                         std::uint64_t vertices, std::uint64_t memory_bytes);

  /// Emits the half-edges of these triangles; one thread a worker.
  virtual void add(std::size_t worker, std::span<const Triangle> triangles,
                   const SlotFrames& frames) = 0;
  /// After the last add(): groups them, and hands out RawEdge and UvEdge groups.
  virtual EdgeResults group(const SlotFrames& frames, bool keep_borders, GroupSinks& sinks) = 0;
};

}  // namespace atlasgauge
