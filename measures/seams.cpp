#include "measures/base/exact_sum.hpp"
#include "measures/base/measure.hpp"

namespace atlasgauge {
namespace {

/// How many edges, and how much length, the atlas cuts open. Their colours are not measured yet.
struct Seams {
  static constexpr std::string_view name = "seams";

  std::uint64_t edges = 0;
  std::uint64_t unsampled = 0;
  ExactSum length;  // model units

  void accumulate(const SeamEdge& edge) {
    ++edges;
    if (!edge.sampled) ++unsampled;
    length.add(edge.length_3d);
  }

  void merge(const Seams& other) {
    edges += other.edges;
    unsampled += other.unsampled;
    length.merge(other.length);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(edges, unsampled, length);
  }

  void finish(const MeshFacts&, Report& report) const {
    report.set("seam_edges", edges);
    report.set("seam_len", length.value());
    report.set("seam_edges_unsampled", unsampled);
  }
};

const Registered<Seams> registered;

}  // namespace
}  // namespace atlasgauge
