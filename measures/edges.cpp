#include "measures/base/measure.hpp"
#include "stream/engine/exact_sum.hpp"

namespace atlasgauge {
namespace {

/// Raw edges by their number of faces, the length of the open ones, and whether faces agree across
/// the others.
struct Edges {
  static constexpr std::string_view name = "edges";

  std::uint64_t edges = 0;
  std::uint64_t boundary = 0;
  std::uint64_t nonmanifold = 0;
  std::uint64_t incoherent = 0;
  ExactSum boundary_length;  // model units

  void accumulate(const RawEdge& edge) {
    ++edges;
    if (edge.faces > 2) ++nonmanifold;
    if (edge.faces == 2 && !edge.coherent) ++incoherent;
    if (edge.faces != 1) return;
    ++boundary;
    boundary_length.add(edge.length_3d);
  }

  void merge(const Edges& other) {
    edges += other.edges;
    boundary += other.boundary;
    nonmanifold += other.nonmanifold;
    incoherent += other.incoherent;
    boundary_length.merge(other.boundary_length);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(edges, boundary, nonmanifold, incoherent, boundary_length);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    report.set("en", edges);
    report.set("en_b", boundary);
    report.set("nonmanif_edge", nonmanifold);
    report.set("oriented", incoherent == 0);
    report.set("boundary_len", boundary_length.value());
    report.set("boundary_len_normalized", boundary_length.value() / facts.box.longest_side());
  }
};

const Registered<Edges> registered;

}  // namespace
}  // namespace atlasgauge
