#include "stream/mesh/chart_sum.hpp"

#include <algorithm>
#include <cmath>

namespace atlasgauge {

void ChartSum::add(const ChartPart& part) {
  if (part.is_border()) return perimeter_.add(part.area_3d_or_length);
  faces_ += part.faces;
  slot_ = part.slot();
  conflict_ = conflict_ || part.conflict();
  if (part.has_uv_triangles()) {
    box_.add({part.low_u, part.low_v});
    box_.add({part.high_u, part.high_v});
  }
  area_3d_.add(part.area_3d_or_length);
  if (part.has_no_area()) return;
  absolute_.add(part.is_negative() ? -part.area_uv : part.area_uv);
  as_is_.add(part.area_uv, !part.is_negative(), part.faces);
  coherent_.add(part.flipped() ? -part.area_uv : part.area_uv, part.is_negative() == part.flipped(),
                part.faces);
}

Chart ChartSum::finish(FaceId number, const SlotFrames& frames) const {
  Chart chart{};
  chart.first_face = number;
  chart.faces = faces_;
  chart.null = as_is_.positive + as_is_.negative == 0;
  chart.orientable = !conflict_;
  chart.slot = slot_;
  chart.area_3d = area_3d_.value();
  chart.area_uv = absolute_.value();
  chart.folds = (conflict_ ? as_is_ : coherent_).folds(chart.area_uv);
  chart.perimeter = perimeter_.value();
  chart.uv_box = box_;
  const SlotFrame& frame = frames.of(chart.slot);
  chart.width = frame.width * (double{box_.high_u} - double{box_.low_u});
  chart.height = frame.height * (double{box_.high_v} - double{box_.low_v});
  return chart;
}

/// Faces against the sign of the total; of a chart closed in UV (|total| <= 1e-9 of the sum of
/// absolute areas), the fewer.
std::uint64_t ChartSum::Signs::folds(double absolute) const {
  const double sum = total.value();
  if (std::abs(sum) <= 1e-9 * absolute) return std::min(positive, negative);
  return sum > 0 ? negative : positive;
}

}  // namespace atlasgauge
