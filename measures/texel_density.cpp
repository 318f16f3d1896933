#include <cmath>

#include "measures/base/measure.hpp"
#include "measures/base/statistics.hpp"
#include "measures/mapping.hpp"

namespace atlasgauge {
namespace {

/// Texels per model unit, sqrt(A_uv / A_3d), by area, over all mapped faces. Its percentiles are
/// the roots of those of A_uv / A_3d, which `scaling` samples.
struct TexelDensity {
  static constexpr std::string_view name = "texel_density";

  WeightedMoments moments;

  void accumulate(const Triangle& triangle) {
    if (!is_mapped(triangle)) return;
    moments.add(std::sqrt(std::abs(triangle.area_uv) / triangle.area_3d), triangle.area_3d);
  }

  void merge(const TexelDensity& other) { moments.merge(other.moments); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(moments);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    const auto root = [](double value) { return std::sqrt(value); };
    report_percentiles(report, "texel_density",
                       mapped(facts.distributions.at("scaling").all.rising, root));
    report_moments(report, "texel_density", moments);
  }
};

const Registered<TexelDensity> registered;

}  // namespace
}  // namespace atlasgauge
