#include <cmath>

#include "measures/base/measure.hpp"
#include "measures/base/statistics.hpp"
#include "measures/mapping.hpp"
#include "stream/engine/exact_sum.hpp"

namespace atlasgauge {
namespace {

/// Quasi-conformal distortion of mapped faces, by area, in both directions: `qcd` is s_max / s_min
/// without the faces of 100 and more, as the peer has it, with their area; `conformality` is the
/// paper's s_min / s_max in [0, 1], of all.
struct Distortion {
  static constexpr std::string_view name = "distortion";
  static constexpr double kLargest = 100;

  WeightedMoments distortion, conformality;
  ExactSum discarded_area;  // model units squared

  std::optional<Sample> sample(const Triangle& triangle) const {
    if (!is_mapped(triangle)) return std::nullopt;
    return Sample{quasi_conformal_distortion(triangle), triangle.area_3d};
  }

  void accumulate(const Sample& taken) {
    conformality.add(1 / taken.value, taken.weight);
    if (taken.value < kLargest) {
      distortion.add(taken.value, taken.weight);
    } else {
      discarded_area.add(taken.weight);
    }
  }

  double cutoff() const { return std::nextafter(kLargest, 0); }

  void merge(const Distortion& other) {
    distortion.merge(other.distortion);
    conformality.merge(other.conformality);
    discarded_area.merge(other.discarded_area);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(distortion, conformality, discarded_area);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    const Distribution& distribution = facts.distributions.at("distortion");
    report_percentiles(report, "qcd", distribution.kept.rising);
    report_moments(report, "qcd", distortion);
    report.set("qcd_discardedArea", discarded_area.value());
    const auto inverse = [](double value) { return 1 / value; };
    report_percentiles(report, "conformality", mapped(distribution.all.falling, inverse));
    report_moments(report, "conformality", conformality);
  }
};

const Registered<Distortion> registered;

}  // namespace
}  // namespace atlasgauge
