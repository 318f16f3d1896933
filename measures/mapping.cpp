#include "measures/mapping.hpp"

#include <algorithm>
#include <cmath>

namespace atlasgauge {

/// With the first 3D edge as x axis the triangle is (0,0), (x1,0), (x2,y2); its images make the
/// columns of J. For J = [a b; c d], Q = |(a+d, c-b)|/2 and R = |(a-d, c+b)|/2 give s_max = Q + R;
/// s_min comes from the determinant, which is the ratio of the areas, because Q - R cancels.
double quasi_conformal_distortion(const Triangle& triangle) {
  const Position& p0 = triangle.p[0];
  const Position &p1 = triangle.p[1], &p2 = triangle.p[2];
  const double ux = p1.x - p0.x, uy = p1.y - p0.y, uz = p1.z - p0.z;
  const double vx = p2.x - p0.x, vy = p2.y - p0.y, vz = p2.z - p0.z;
  const double x1 = std::sqrt(ux * ux + uy * uy + uz * uz);
  const double x2 = (ux * vx + uy * vy + uz * vz) / x1;
  const double y2 = 2 * triangle.area_3d / x1;
  const double a = (triangle.texel[1].x - triangle.texel[0].x) / x1;
  const double c = (triangle.texel[1].y - triangle.texel[0].y) / x1;
  const double b = (triangle.texel[2].x - triangle.texel[0].x - a * x2) / y2;
  const double d = (triangle.texel[2].y - triangle.texel[0].y - c * x2) / y2;
  const double q = 0.5 * std::sqrt((a + d) * (a + d) + (c - b) * (c - b));
  const double r = 0.5 * std::sqrt((a - d) * (a - d) + (c + b) * (c + b));
  const double largest = q + r;
  const double smallest = std::abs(triangle.area_uv) / triangle.area_3d / largest;
  return std::max(1.0, largest / smallest);
}

}  // namespace atlasgauge
