#include <cmath>

#include "measures/base/measure.hpp"
#include "measures/base/statistics.hpp"
#include "measures/mapping.hpp"

namespace atlasgauge {
namespace {

/// Texels per model unit, sqrt(A_uv / A_3d), by area, over all mapped faces.
struct TexelDensity {
  static constexpr std::string_view name = "texel_density";

  WeightedMoments moments;

  std::optional<Sample> sample(const Triangle& triangle) const {
    if (!is_mapped(triangle)) return std::nullopt;
    return Sample{std::sqrt(std::abs(triangle.area_uv) / triangle.area_3d), triangle.area_3d};
  }

  void accumulate(const Sample& taken) { moments.add(taken.value, taken.weight); }

  void merge(const TexelDensity& other) { moments.merge(other.moments); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(moments);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    report_percentiles(report, "texel_density", facts.quantiles.at("texel_density").rising);
    report_moments(report, "texel_density", moments);
  }
};

const Registered<TexelDensity> registered;

}  // namespace
}  // namespace atlasgauge
