#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "measures/base/float_digits.hpp"
#include "measures/base/measure.hpp"
#include "measures/base/spill_lookup.hpp"

namespace atlasgauge {
namespace {

/// An order of all seam edges, as no two have the same vertices.
bool is_worse(const SeamEdge& a, const SeamEdge& b) {
  const auto rank = [](const SeamEdge& edge) {
    return std::tuple(-edge.discrepancy, -edge.length_3d, edge.v[0], edge.v[1]);
  };
  return rank(a) < rank(b);
}

Json json_of(const Position& p) {
  return Json::array({p.x, p.y, p.z});
}

Json json_of(const TexCoord& t) {
  return Json::array({double_of_digits(t.u), double_of_digits(t.v)});
}

Json json_of(const SeamSide& side) {
  return {
      {"texture", raw(side.slot)}, {"uv_from", json_of(side.t[0])}, {"uv_to", json_of(side.t[1])}};
}

Json json_of(const SeamEdge& edge, const Position& from, const Position& to) {
  return {{"discrepancy", edge.discrepancy},
          {"length_3d", edge.length_3d},
          {"samples", edge.samples},
          {"from", json_of(from)},
          {"to", json_of(to)},
          {"sides", Json::array({json_of(edge.sides[0]), json_of(edge.sides[1])})}};
}

/// The seam edges whose colours agree least, and where they are.
struct WorstSeams {
  static constexpr std::string_view name = "worst_seams";
  static constexpr std::size_t kMost = 20;

  std::array<SeamEdge, kMost> edges;  // worst first
  std::uint64_t count = 0;

  void accumulate(const SeamEdge& edge) {
    if (edge.samples == 0) return;
    const auto end = edges.begin() + static_cast<std::ptrdiff_t>(count);
    const auto place = std::upper_bound(edges.begin(), end, edge, is_worse);
    if (place == edges.end()) return;
    if (count < kMost) ++count;
    std::move_backward(place, edges.begin() + static_cast<std::ptrdiff_t>(count) - 1,
                       edges.begin() + static_cast<std::ptrdiff_t>(count));
    *place = edge;
  }

  void merge(const WorstSeams& other) {
    for (std::size_t i = 0; i < other.count; ++i) accumulate(other.edges[i]);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(count);
    for (SeamEdge& edge : edges) {
      archive(edge.v, edge.sides, edge.length_3d, edge.samples, edge.discrepancy);
    }
  }

  void finish(const MeshFacts& facts, Report& report) const {
    SpillLookup<Position> positions(facts.vertices);
    Json list = Json::array();
    for (std::size_t i = 0; i < count; ++i) {
      const auto& v = edges[i].v;
      const Position from = positions.at(raw(v[0])), to = positions.at(raw(v[1]));
      list.push_back(json_of(edges[i], from, to));
    }
    report.set("worst_seams", std::move(list));
  }
};

const Registered<WorstSeams> registered;

}  // namespace
}  // namespace atlasgauge
