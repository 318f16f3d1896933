#include "measures/base/measure.hpp"
#include "measures/base/statistics.hpp"
#include "measures/mapping.hpp"

namespace atlasgauge {
namespace {

/// The paper's direction of the distortion, s_min / s_max in [0, 1] by area, over all mapped faces.
struct Conformality {
  static constexpr std::string_view name = "conformality";

  WeightedMoments moments;

  std::optional<Sample> sample(const Triangle& triangle) const {
    if (!is_mapped(triangle)) return std::nullopt;
    return Sample{1 / quasi_conformal_distortion(triangle), triangle.area_3d};
  }

  void accumulate(const Sample& taken) { moments.add(taken.value, taken.weight); }

  void merge(const Conformality& other) { moments.merge(other.moments); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(moments);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    report_percentiles(report, "conformality", facts.quantiles.at("conformality").rising);
    report_moments(report, "conformality", moments);
  }
};

const Registered<Conformality> registered;

}  // namespace
}  // namespace atlasgauge
