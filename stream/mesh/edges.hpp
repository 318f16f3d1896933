#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include "stream/engine/engine.hpp"
#include "stream/engine/labels.hpp"
#include "stream/engine/last_uses.hpp"
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
  Spill<OpenEdge> open;       ///< welded boundary edges; empty unless they were to be kept
  bool raw_manifold = true;   ///< no raw edge has more than two faces
  bool uv_manifold = true;    ///< no uv edge has more than two faces
};

/// The edge table. Every face emits three half-edges, which are grouped by their lower welded
/// vertex; one grouping serves all three levels, since raw and uv edges nest inside welded ones.
/// Faces on one edge are linked in a chain, not all with all.
class EdgeTable {
 public:
  struct Plan {
    bool welded;  ///< some vertices coincide
    std::uint64_t faces;
    std::uint64_t vertices;
    std::uint64_t memory_bytes;  ///< may be taken until settle()
    bool keep_borders;
    bool keep_open = false;
  };

  virtual ~EdgeTable() = default;

  /// Hands out RawEdge and UvEdge groups, beginning with the first add(). `last_faces` are of
  /// welded vertices.
  static std::unique_ptr<EdgeTable> make(const Engine& engine, const Plan& plan,
                                         const LastUses& last_faces, const SlotFrames& frames,
                                         GroupSinks& sinks);

  /// Emits the half-edges of these triangles, and groups some that are complete; one thread a
  /// worker.
  virtual void add(std::size_t worker, std::span<const Triangle> triangles) = 0;
  /// The first `faces` faces have been added; one thread at a time.
  virtual void pass(std::uint64_t faces) = 0;
  /// After the last add(): groups what is in memory, and frees that.
  virtual void settle() = 0;
  /// After settle(): groups the rest.
  virtual EdgeResults finish() = 0;
};

}  // namespace atlasgauge
