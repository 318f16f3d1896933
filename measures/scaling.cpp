#include <cmath>

#include "measures/base/exact_sum.hpp"
#include "measures/base/measure.hpp"
#include "measures/base/weighted_moments.hpp"
#include "measures/mapping.hpp"

namespace atlasgauge {
namespace {

/// UV scaling s_f = (A_uv / A_3d) / (sum A_uv / sum A_3d) by area, over all mapped faces, as the
/// paper defines it. The average is 1 by construction. The trimmed sf_* need the occupancy and are
/// not measured yet.
struct Scaling {
  static constexpr std::string_view name = "scaling";

  WeightedMoments ratio;  // A_uv / A_3d
  ExactSum area_uv, area_3d;

  void accumulate(const Triangle& triangle) {
    if (!is_mapped(triangle)) return;
    ratio.add(std::abs(triangle.area_uv) / triangle.area_3d, triangle.area_3d);
    area_uv.add(std::abs(triangle.area_uv));
    area_3d.add(triangle.area_3d);
  }

  void merge(const Scaling& other) {
    ratio.merge(other.ratio);
    area_uv.merge(other.area_uv);
    area_3d.merge(other.area_3d);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(ratio, area_uv, area_3d);
  }

  void finish(const MeshFacts&, Report& report) const {
    const double mean = area_uv.value() / area_3d.value();
    report.set("sf_untrimmed_avg", ratio.mean() / mean);
    report.set("sf_untrimmed_var", ratio.variance() / (mean * mean));
  }
};

const Registered<Scaling> registered;

}  // namespace
}  // namespace atlasgauge
