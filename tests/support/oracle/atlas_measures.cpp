#include "tests/support/oracle/atlas_measures.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "tests/support/oracle/geometry.hpp"
#include "tests/support/oracle/groups.hpp"
#include "tests/support/oracle/statistics.hpp"

namespace atlasgauge::oracle {
namespace {

using nlohmann::json;

struct Chart {
  Wide total_signed = 0;
  Wide total_absolute = 0;
  int64_t positive_faces = 0;
  int64_t negative_faces = 0;
  bool orientable = true;
};

std::map<int64_t, Chart> charts_of(const Analysis& analysis) {
  const Coherence coherence = make_coherent(analysis.uv_edges, analysis.faces.size());
  std::map<int64_t, Chart> charts;
  for (const int64_t face : coherence.contradictions) {
    charts[analysis.faces[static_cast<size_t>(face)].chart].orientable = false;
  }
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const FaceFacts& face = analysis.faces[f];
    if (!face.welded) continue;
    Chart& chart = charts[face.chart];
    const bool flip = chart.orientable && *coherence.flipped[f];
    const double area = flip ? -face.signed_uv_area : face.signed_uv_area;
    chart.total_signed += area;
    chart.total_absolute += std::abs(area);
    if (area > 0) ++chart.positive_faces;
    if (area < 0) ++chart.negative_faces;
  }
  return charts;
}

int64_t folds_of(const Chart& chart) {
  if (abs(chart.total_signed) <= Wide(1e-9) * chart.total_absolute) {
    return std::min(chart.positive_faces, chart.negative_faces);
  }
  return chart.total_signed > 0 ? chart.negative_faces : chart.positive_faces;
}

void report_charts(json& report, const std::map<int64_t, Chart>& charts) {
  int64_t null_charts = 0, folds = 0, non_orientable = 0;
  for (const auto& [number, chart] : charts) {
    if (chart.total_absolute == 0) ++null_charts;
    if (!chart.orientable) ++non_orientable;
    folds += folds_of(chart);
  }
  report["num_charts"] = charts.size();
  report["num_null_charts"] = null_charts;
  report["nfolds"] = folds;
  report["charts_nonorientable"] = non_orientable;
}

Wide boundary_length_uv(const Analysis& analysis) {
  std::vector<double> lengths;
  for (const auto& [edge, uses] : analysis.uv_edges) {
    const FaceFacts& face = analysis.faces[static_cast<size_t>(uses.front().face)];
    if (uses.size() != 1 || !face.has_uv_triangle) continue;
    const auto k = static_cast<size_t>(uses.front().corner);
    lengths.push_back(texel_distance(face.texels[k], face.texels[(k + 1) % 3]));
  }
  return exact_sum(lengths);
}

Wide total_uv_area(const Analysis& analysis) {
  Wide sum = 0;
  for (const FaceFacts& face : analysis.faces) sum += std::abs(face.signed_uv_area);
  return sum;
}

void report_uv_sizes(json& report, const Analysis& analysis) {
  const Wide area = total_uv_area(analysis);
  const Wide boundary = boundary_length_uv(analysis);
  const Wide circle = sqrt(Wide(4 * std::numbers::pi) * area);
  report["en_uv"] = analysis.uv_edges.size();
  report["en_uv_b"] = count_boundary(analysis.uv_edges);
  report["area_uv"] = rounded(area);
  report["boundary_len_uv"] = rounded(boundary);
  report["crumbliness"] = ratio(boundary, circle);
  report["solidity"] = area == 0 ? json(nullptr) : ratio(circle, boundary);
}

json mapped_fraction(const Analysis& analysis) {
  Wide mapped = 0, all = 0;
  for (const FaceFacts& face : analysis.faces) {
    if (!face.welded) continue;
    all += face.area;
    if (has_both_areas(face)) mapped += face.area;
  }
  return ratio(mapped, all);
}

void report_slots(json& report, const Model& model) {
  report["ntex"] = model.slots.size();
  report["textures"] = json::array();
  for (const Slot& slot : model.slots) report["textures"].push_back(slot.name);
}

// With the Gram matrices G of the sides a, b in space and H of the same sides d, e on the texture,
// the squared singular values of the Jacobian are the eigenvalues of H G^-1. Scaled by
// |a x b| |d x e| their sum becomes `trace` below and their product's root becomes `twice_det` / 2.
struct SingularValues {
  Wide trace;
  Wide twice_det;
};

std::array<Wide, 3> wide_difference(const Position& p, const Position& q) {
  return {Wide(p[0]) - q[0], Wide(p[1]) - q[1], Wide(p[2]) - q[2]};
}

Wide wide_dot(const std::array<Wide, 3>& a, const std::array<Wide, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

SingularValues singular_values(const std::array<Position, 3>& p, const std::array<Texel, 3>& t) {
  const auto a = wide_difference(p[1], p[0]);
  const auto b = wide_difference(p[2], p[0]);
  const auto d = wide_difference({t[1][0], t[1][1], 0}, {t[0][0], t[0][1], 0});
  const auto e = wide_difference({t[2][0], t[2][1], 0}, {t[0][0], t[0][1], 0});
  const Wide aa = wide_dot(a, a), bb = wide_dot(b, b), ab = wide_dot(a, b);
  const Wide trace = bb * wide_dot(d, d) - 2 * ab * wide_dot(d, e) + aa * wide_dot(e, e);
  const Wide det_3d_squared = aa * bb - ab * ab;
  const Wide det_uv = d[0] * e[1] - d[1] * e[0];
  return {trace, 2 * sqrt(det_3d_squared) * abs(det_uv)};
}

// (s_max + s_min)^2 and (s_max - s_min)^2 are trace ± twice_det, up to the common scale.
Wide larger_over_mean(const SingularValues& s) {
  const Wide difference = s.trace * s.trace - s.twice_det * s.twice_det;
  return s.trace + (difference > 0 ? Wide(sqrt(difference)) : Wide(0));
}

void report_distortion(json& report, const Analysis& analysis) {
  Samples qcd, conformality;
  Wide discarded = 0;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const FaceFacts& face = analysis.faces[f];
    if (!has_both_areas(face)) continue;
    const SingularValues s = singular_values(
        corner_positions(analysis.model, analysis.model.faces[f].vertices), face.texels);
    const Wide larger = larger_over_mean(s);
    const double stretch =
        s.twice_det == 0 ? std::numeric_limits<double>::infinity() : rounded(larger / s.twice_det);
    conformality.push_back({rounded(s.twice_det / larger), face.area});
    if (stretch < 100) qcd.push_back({stretch, face.area});
    if (stretch >= 100) discarded += face.area;
  }
  report_statistics(report, "qcd", qcd);
  report_statistics(report, "conformality", conformality);
  report["qcd_discardedArea"] = rounded(discarded);
}

double smallest_angle_degrees(const std::array<Position, 3>& p) {
  double smallest = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < 3; ++k) {
    const Position a = minus(p[(k + 1) % 3], p[k]);
    const Position b = minus(p[(k + 2) % 3], p[k]);
    smallest = std::min(smallest, std::atan2(length(cross(a, b)), dot(a, b)));
  }
  return smallest * (180 / std::numbers::pi);
}

void report_angles(json& report, const Analysis& analysis) {
  Samples angles;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const FaceFacts& face = analysis.faces[f];
    if (face.area == 0) continue;
    const auto corners = corner_positions(analysis.model, analysis.model.faces[f].vertices);
    angles.push_back({smallest_angle_degrees(corners), face.area});
  }
  report_statistics(report, "angle_min", angles);
}

bool is_unmapped(const Face& face) {
  return std::any_of(face.uvs.begin(), face.uvs.end(),
                     [](const std::optional<Uv>& uv) { return !uv.has_value(); });
}

bool reaches_outside(const Face& face) {
  return std::any_of(face.uvs.begin(), face.uvs.end(), [](const std::optional<Uv>& uv) {
    return uv && ((*uv)[0] < 0 || (*uv)[0] > 1 || (*uv)[1] < 0 || (*uv)[1] > 1);
  });
}

bool is_untextured(const Model& model, const Face& face) {
  return !face.slot || !model.slots[static_cast<size_t>(*face.slot)].size;
}

void report_mapping_counts(json& report, const Analysis& analysis) {
  int64_t unmapped = 0, untextured = 0, outside = 0, far = 0;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const Face& face = analysis.model.faces[f];
    if (!analysis.faces[f].raw) continue;
    unmapped += is_unmapped(face);
    untextured += is_untextured(analysis.model, face);
    outside += reaches_outside(face);
    far += analysis.faces[f].uv_far;
  }
  report["faces_unmapped"] = unmapped;
  report["faces_untextured"] = untextured;
  report["faces_uv_outside"] = outside;
  report["uv_far"] = far;
}

}  // namespace

void report_atlas(json& report, const Analysis& analysis) {
  const std::map<int64_t, Chart> charts = charts_of(analysis);
  report_slots(report, analysis.model);
  report_charts(report, charts);
  report_uv_sizes(report, analysis);
  report["mapped_fraction"] = mapped_fraction(analysis);
  report_distortion(report, analysis);
  report_angles(report, analysis);
  report_mapping_counts(report, analysis);
}

}  // namespace atlasgauge::oracle
