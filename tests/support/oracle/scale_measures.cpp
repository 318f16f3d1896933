#include "tests/support/oracle/scale_measures.hpp"

#include <cmath>
#include <vector>

#include "tests/support/oracle/statistics.hpp"

namespace atlasgauge::oracle {
namespace {

using nlohmann::json;

struct Mapped {
  double area_3d;
  double area_uv;
};

std::vector<Mapped> mapped_faces(const Analysis& analysis) {
  std::vector<Mapped> faces;
  for (const FaceFacts& face : analysis.faces) {
    if (has_both_areas(face)) faces.push_back({face.area, std::abs(face.signed_uv_area)});
  }
  return faces;
}

Wide sum_of(double Mapped::*area, const std::vector<Mapped>& faces) {
  Wide sum = 0;
  for (const Mapped& face : faces) sum += face.*area;
  return sum;
}

Samples scale_factors(const std::vector<Mapped>& faces) {
  const Wide area_3d = sum_of(&Mapped::area_3d, faces), area_uv = sum_of(&Mapped::area_uv, faces);
  Samples samples;
  for (const Mapped& face : faces) {
    const Wide scale = Wide(face.area_uv) * area_3d / (Wide(face.area_3d) * area_uv);
    samples.push_back({rounded(scale), face.area_3d});
  }
  return samples;
}

// A_uv > 100 · (A_3d / ΣA_3d) · (occupancy · all texels), cleared of the fractions.
bool is_cut(const Mapped& face, const Wide& mapped_area_3d, const Coverage& coverage) {
  const Wide covered = Wide(coverage.covered) * coverage.of_all_slots;
  return Wide(face.area_uv) * mapped_area_3d * coverage.of_covered_slots >
         100 * Wide(face.area_3d) * covered;
}

void report_trimmed(json& report, const std::vector<Mapped>& faces,
                    const std::optional<Coverage>& coverage) {
  const Wide mapped_area_3d = sum_of(&Mapped::area_3d, faces);
  std::vector<Mapped> kept, cut;
  for (const Mapped& face : faces) {
    const bool discard = coverage && is_cut(face, mapped_area_3d, *coverage);
    (discard ? cut : kept).push_back(face);
  }
  report_statistics(report, "sf", scale_factors(kept));
  report["sf_discardedArea"] = rounded(sum_of(&Mapped::area_3d, cut));
}

void report_untrimmed(json& report, const std::vector<Mapped>& faces) {
  report["sf_untrimmed_avg"] = report["sf_untrimmed_var"] = nullptr;
  if (faces.empty()) return;
  const Samples scale = scale_factors(faces);
  const Wide mean = average(scale);
  report["sf_untrimmed_avg"] = rounded(mean);
  report["sf_untrimmed_var"] = rounded(mean_square(scale, mean));
}

}  // namespace

void report_scale(json& report, const Analysis& analysis, const std::optional<Coverage>& coverage) {
  const std::vector<Mapped> faces = mapped_faces(analysis);
  Samples density;
  for (const Mapped& face : faces) {
    density.push_back({std::sqrt(face.area_uv / face.area_3d), face.area_3d});
  }
  report_statistics(report, "texel_density", density);
  report_trimmed(report, faces, coverage);
  report_untrimmed(report, faces);
}

}  // namespace atlasgauge::oracle
