#include <cmath>
#include <numbers>

#include "measures/base/measure.hpp"
#include "measures/base/statistics.hpp"

namespace atlasgauge {
namespace {

/// Twice the area and the dot product at one corner: the angle is atan2(cross, dot).
struct CornerAngle {
  double cross, dot;
  bool operator<(const CornerAngle& other) const { return dot * other.cross > other.dot * cross; }
};

CornerAngle angle_at(const Position& p, const Position& q, const Position& r) {
  const double ax = q.x - p.x, ay = q.y - p.y, az = q.z - p.z;
  const double bx = r.x - p.x, by = r.y - p.y, bz = r.z - p.z;
  const double cx = ay * bz - az * by, cy = az * bx - ax * bz, cz = ax * by - ay * bx;
  return {std::sqrt(cx * cx + cy * cy + cz * cz), ax * bx + ay * by + az * bz};
}

/// The smallest interior angle of faces with area, in degrees, by area: the paper's "extremely
/// irregular triangulations".
struct TriangleShape {
  static constexpr std::string_view name = "angle_min";

  WeightedMoments moments;

  std::optional<Sample> sample(const Triangle& triangle) const {
    if (!triangle.at_raw_level() || triangle.area_3d == 0) return std::nullopt;
    const Position* p = triangle.p;
    const CornerAngle smallest = std::min(
        {angle_at(p[0], p[1], p[2]), angle_at(p[1], p[2], p[0]), angle_at(p[2], p[0], p[1])});
    return Sample{std::atan2(smallest.cross, smallest.dot) * (180 / std::numbers::pi),
                  triangle.area_3d};
  }

  void accumulate(const Sample& taken) { moments.add(taken.value, taken.weight); }

  void merge(const TriangleShape& other) { moments.merge(other.moments); }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(moments);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    report_percentiles(report, "angle_min", facts.distributions.at("angle_min").all.rising);
    report_moments(report, "angle_min", moments);
  }
};

const Registered<TriangleShape> registered;

}  // namespace
}  // namespace atlasgauge
