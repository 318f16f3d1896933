#include "measures/base/exact_sum.hpp"
#include "measures/base/measure.hpp"
#include "measures/base/statistics.hpp"
#include "measures/mapping.hpp"

namespace atlasgauge {
namespace {

/// Quasi-conformal distortion s_max / s_min of mapped faces, by area. Faces of 100 and more are
/// left out, as the peer does; their area says how much that is.
struct Distortion {
  static constexpr std::string_view name = "qcd";
  static constexpr double kLargest = 100;

  WeightedMoments moments;
  ExactSum discarded_area;  // model units squared

  std::optional<Sample> sample(const Triangle& triangle) {
    if (!is_mapped(triangle)) return std::nullopt;
    const double distortion = quasi_conformal_distortion(triangle);
    if (distortion < kLargest) return Sample{distortion, triangle.area_3d};
    discarded_area.add(triangle.area_3d);
    return std::nullopt;
  }

  void accumulate(const Sample& taken) { moments.add(taken.value, taken.weight); }

  void merge(const Distortion& other) {
    moments.merge(other.moments);
    discarded_area.merge(other.discarded_area);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(moments, discarded_area);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    report_percentiles(report, "qcd", facts.quantiles.at("qcd").rising);
    report_moments(report, "qcd", moments);
    report.set("qcd_discardedArea", discarded_area.value());
  }
};

const Registered<Distortion> registered;

}  // namespace
}  // namespace atlasgauge
