#pragma once

#include <cstdint>

#include "stream/engine/engine.hpp"
#include "stream/engine/labels.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/records.hpp"

namespace atlasgauge {

/// Labels of the faces by the links of one level: over all of its edges, and over its manifold
/// edges with parity. Where no edge has more than two faces the two are one.
class FaceLabels {
 public:
  FaceLabels(const Engine& engine, Spill<Link> links, std::uint64_t faces, bool manifold);

  Spill<Label>& by_all_edges() { return manifold_ ? by_manifold_edges_ : by_all_edges_; }
  Spill<Label>& by_manifold_edges() { return by_manifold_edges_; }

 private:
  bool manifold_;
  Spill<Label> by_manifold_edges_;
  Spill<Label> by_all_edges_;
};

/// Hands out the connected components at the raw level.
void group_components(const Engine& engine, FaceLabels& labels, Spill<FaceLevels>& levels,
                      GroupSinks& sinks);

/// Connected components of the boundary edges over shared vertices. `boundary_vertices` is the
/// number of vertices on boundary edges.
std::uint64_t count_boundary_components(const Engine& engine, Spill<Link> boundary_links,
                                        std::uint64_t vertices, std::uint64_t boundary_vertices);

}  // namespace atlasgauge
