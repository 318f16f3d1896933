#include <algorithm>

#include "measures/base/measure.hpp"

namespace atlasgauge {
namespace {

/// Components, boundary loops, genus and Euler characteristic, from counts of all element kinds.
struct Topology {
  static constexpr std::string_view name = "topology";

  std::int64_t faces = 0;
  std::int64_t edges = 0;
  std::int64_t vertices = 0;  // referenced
  std::uint64_t nonmanifold_edges = 0;
  std::uint64_t nonmanifold_vertices = 0;
  std::uint64_t duplicate_faces = 0;
  std::uint64_t components = 0;
  std::uint64_t unorientable = 0;
  std::uint64_t largest_component = 0;

  void accumulate(const RawEdge& edge) {
    ++edges;
    if (edge.faces > 2) ++nonmanifold_edges;
  }
  void accumulate(const VertexStar& star) {
    ++vertices;
    duplicate_faces += star.duplicate_faces;
    if (!star.nonmanifold_edge && !star.one_fan) ++nonmanifold_vertices;
  }
  void accumulate(const Component& component) {
    ++components;
    faces += static_cast<std::int64_t>(component.faces);
    largest_component = std::max(largest_component, component.faces);
    if (!component.orientable) ++unorientable;
  }

  void merge(const Topology& other) {
    faces += other.faces;
    edges += other.edges;
    vertices += other.vertices;
    nonmanifold_edges += other.nonmanifold_edges;
    nonmanifold_vertices += other.nonmanifold_vertices;
    duplicate_faces += other.duplicate_faces;
    components += other.components;
    unorientable += other.unorientable;
    largest_component = std::max(largest_component, other.largest_component);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(faces, edges, vertices, nonmanifold_edges, nonmanifold_vertices, duplicate_faces,
            components, unorientable, largest_component);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    const bool manifold = nonmanifold_edges == 0 && nonmanifold_vertices == 0;
    const auto loops = static_cast<std::int64_t>(facts.boundary_components);
    report.set("nonmanif_vert", nonmanifold_vertices);
    report.set("connected_components", components);
    report.set("largest_component_fn", largest_component);
    report.set("boundary_components", facts.boundary_components);
    report.set("boundary_loops", manifold ? loops : std::int64_t{-1});
    report.set("euler", vertices - edges + faces);
    report.set("genus", manifold ? genus(loops) : std::int64_t{-1});
    report.set("orientable", unorientable == 0);
    report.set("fndup", duplicate_faces);
    report.set("vnunref", facts.positions - static_cast<std::uint64_t>(vertices));
  }

 private:
  std::int64_t genus(std::int64_t loops) const {
    return -(vertices + faces - edges + loops - 2 * static_cast<std::int64_t>(components)) / 2;
  }
};

const Registered<Topology> registered;

}  // namespace
}  // namespace atlasgauge
