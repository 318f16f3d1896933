#include <cmath>

#include "measures/base/measure.hpp"
#include "measures/base/statistics.hpp"
#include "measures/base/weighted_moments.hpp"
#include "measures/texture_seams.hpp"
#include "stream/engine/exact_sum.hpp"

namespace atlasgauge {
namespace {

/// How many edges, and how much length, the atlas cuts open, and how well the colours on their two
/// sides agree: D(e), every edge weighted by its length in 3D (SPEC section 5).
struct Seams {
  static constexpr std::string_view name = "seams";

  std::uint64_t edges = 0;
  std::uint64_t unsampled = 0;
  ExactSum length;  // model units
  WeightedMoments discrepancy;
  WeightedMoments texmetro;  // of the same edges, where it was asked for

  void accumulate(const SeamEdge& edge) {
    ++edges;
    if (!edge.sampled) ++unsampled;
    length.add(edge.length_3d);
    if (edge.samples == 0) return;
    discrepancy.add(edge.discrepancy, edge.length_3d);
    if (!std::isnan(edge.texmetro_discrepancy)) {
      texmetro.add(edge.texmetro_discrepancy, edge.length_3d);
    }
  }

  void merge(const Seams& other) {
    edges += other.edges;
    unsampled += other.unsampled;
    length.merge(other.length);
    discrepancy.merge(other.discrepancy);
    texmetro.merge(other.texmetro);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(edges, unsampled, length, discrepancy, texmetro);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    report.set("seam_edges", edges);
    report.set("seam_len", length.value());
    report.set("seam_edges_unsampled", unsampled);
    report.set("seam_discrepancy_by_texture", seam_discrepancy_by_texture(facts));
    const bool seamless = facts.textures.has_images && edges == 0;
    report_moments(report, "seam_discrepancy", or_zero(discrepancy, seamless));
    if (!facts.texmetro_seams) return;
    report.set("seam_discrepancy_texmetro_avg", or_zero(texmetro, seamless).mean());
  }

  /// Textures without seams have none that shows, as TexMetro has it.
  static WeightedMoments or_zero(const WeightedMoments& moments, bool seamless) {
    if (!seamless) return moments;
    WeightedMoments zero;
    zero.add(0, 1);
    return zero;
  }
};

const Registered<Seams> registered;

}  // namespace
}  // namespace atlasgauge
