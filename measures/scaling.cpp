#include <cmath>

#include "measures/base/measure.hpp"
#include "measures/base/statistics.hpp"
#include "measures/mapping.hpp"
#include "measures/occupancy.hpp"

namespace atlasgauge {
namespace {

/// UV scaling s_f = (A_uv / A_3d) / (sum A_uv / sum A_3d) by area. `sf_untrimmed` is over all
/// mapped faces, as the paper defines it. `sf` leaves out, as the peer does, those with
///
///   A_uv > 100 (A_3d / sum A_3d) (occupancy x texels of all slots)
///
/// which is a bound on A_uv / A_3d, and takes its sums over the faces kept. Both averages are 1 by
/// construction.
struct Scaling {
  static constexpr std::string_view name = "scaling";

  WeightedMoments ratio;      // A_uv / A_3d, texels squared per model unit squared
  WeightedMoments discarded;  // of these
  Occupancy occupancy;

  std::optional<Sample> sample(const Triangle& triangle) const {
    if (!is_mapped(triangle)) return std::nullopt;
    return Sample{std::abs(triangle.area_uv) / triangle.area_3d, triangle.area_3d};
  }

  void accumulate(const Sample& taken) { ratio.add(taken.value, taken.weight); }
  void accumulate(const TextureLevel& level) { occupancy.add(level); }
  void cut(const Sample& sample) { discarded.add(sample.value, sample.weight); }

  double cutoff() const {
    const double bound =
        100 / ratio.weight() * (occupancy.value() * static_cast<double>(occupancy.texels()));
    return std::isnan(bound) ? std::numeric_limits<double>::infinity() : bound;
  }

  void merge(const Scaling& other) {
    ratio.merge(other.ratio);
    discarded.merge(other.discarded);
    occupancy.merge(other.occupancy);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(ratio, discarded, occupancy);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    const Distribution& distribution = facts.distributions.at("scaling");
    WeightedMoments kept = ratio;
    kept.remove(discarded, distribution.largest_kept);
    const double unit = kept.mean();
    const auto in_units = [&](double value) { return value / unit; };
    report_percentiles(report, "sf", mapped(distribution.kept.rising, in_units));
    report_moments(report, "sf", kept, unit);
    report.set("sf_discardedArea", discarded.weight());
    report.set("sf_untrimmed_avg", ratio.mean() / ratio.mean());
    report.set("sf_untrimmed_var", ratio.variance() / ratio.mean() / ratio.mean());
  }
};

const Registered<Scaling> registered;

}  // namespace
}  // namespace atlasgauge
