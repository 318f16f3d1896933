#include <cmath>
#include <numbers>

#include "measures/base/measure.hpp"
#include "stream/engine/exact_sum.hpp"

namespace atlasgauge {
namespace {

/// The perimeter of all charts against that of one disk of their area (the paper, "Atlas
/// crumbliness"): C = boundary_len_uv / sqrt(4 pi area_uv), at least 1 for one simple chart.
struct Crumbliness {
  static constexpr std::string_view name = "crumbliness";

  std::uint64_t edges = 0;
  std::uint64_t boundary = 0;
  ExactSum boundary_length;  // texels
  ExactSum area;             // texels squared

  void accumulate(const UvEdge& edge) {
    ++edges;
    if (edge.faces != 1) return;
    ++boundary;
    boundary_length.add(edge.length_texels);
  }
  void accumulate(const Triangle& triangle) {
    if (triangle.at_welded_level()) area.add(std::abs(triangle.area_uv));
  }

  void merge(const Crumbliness& other) {
    edges += other.edges;
    boundary += other.boundary;
    boundary_length.merge(other.boundary_length);
    area.merge(other.area);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(edges, boundary, boundary_length, area);
  }

  void finish(const MeshFacts&, Report& report) const {
    const double disk = std::sqrt(4 * std::numbers::pi * area.value());
    const double crumbliness = boundary_length.value() / disk;
    report.set("en_uv", edges);
    report.set("en_uv_b", boundary);
    report.set("area_uv", area.value());
    report.set("boundary_len_uv", boundary_length.value());
    report.set("crumbliness", crumbliness);
    report.set("solidity",
               disk > 0 ? 1 / crumbliness : crumbliness);  // neither exists over no area
  }
};

const Registered<Crumbliness> registered;

}  // namespace
}  // namespace atlasgauge
