#include "tests/support/oracle/geometry.hpp"

#include <algorithm>
#include <cmath>

namespace atlasgauge::oracle {

bool is_finite(const Position& position) {
  return std::all_of(position.begin(), position.end(), [](double x) { return std::isfinite(x); });
}

Position without_negative_zero(const Position& p) {
  return {p[0] + 0.0, p[1] + 0.0, p[2] + 0.0};
}

Position minus(const Position& p, const Position& q) {
  return {p[0] - q[0], p[1] - q[1], p[2] - q[2]};
}

Position cross(const Position& a, const Position& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Position& a, const Position& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double length(const Position& a) {
  return std::sqrt(dot(a, a));
}

double texel_distance(const Texel& a, const Texel& b) {
  const double dx = a[0] - b[0];
  const double dy = a[1] - b[1];
  return std::sqrt(dx * dx + dy * dy);
}

std::array<Position, 3> corner_positions(const Model& model, const Triple& vertices) {
  std::array<Position, 3> corners;
  for (size_t k = 0; k < 3; ++k) corners[k] = model.positions[static_cast<size_t>(vertices[k])];
  return corners;
}

double triangle_area(const std::array<Position, 3>& p) {
  return 0.5 * length(cross(minus(p[1], p[0]), minus(p[2], p[0])));
}

double signed_texel_area(const std::array<Texel, 3>& t) {
  return 0.5 *
         ((t[1][0] - t[0][0]) * (t[2][1] - t[0][1]) - (t[2][0] - t[0][0]) * (t[1][1] - t[0][1]));
}

double edge_length(const Model& model, const EdgeKey& edge) {
  return length(minus(model.positions[static_cast<size_t>(edge.first)],
                      model.positions[static_cast<size_t>(edge.second)]));
}

}  // namespace atlasgauge::oracle
