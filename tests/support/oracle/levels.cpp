#include "tests/support/oracle/levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

#include "tests/support/oracle/geometry.hpp"
#include "tests/support/oracle/groups.hpp"

namespace atlasgauge::oracle {
namespace {

bool has_repetition(const Triple& t) {
  return t[0] == t[1] || t[1] == t[2] || t[0] == t[2];
}

std::vector<int64_t> weld(const std::vector<Position>& positions) {
  std::map<Position, int64_t> first_of;
  std::vector<int64_t> welded(positions.size(), -1);
  for (size_t v = 0; v < positions.size(); ++v) {
    if (!is_finite(positions[v])) continue;
    const Position key = without_negative_zero(positions[v]);
    welded[v] = first_of.try_emplace(key, static_cast<int64_t>(v)).first->second;
  }
  return welded;
}

void sort_out_levels(Analysis& analysis) {
  const Model& model = analysis.model;
  const std::vector<int64_t> welded = weld(model.positions);
  for (size_t f = 0; f < model.faces.size(); ++f) {
    FaceFacts& facts = analysis.faces[f];
    const Triple& vertices = model.faces[f].vertices;
    const std::array<Position, 3> corners = corner_positions(model, vertices);
    facts.degenerate = has_repetition(vertices);
    facts.non_finite = !facts.degenerate && !std::all_of(corners.begin(), corners.end(), is_finite);
    facts.raw = !facts.degenerate && !facts.non_finite;
    if (!facts.raw) continue;
    facts.area = triangle_area(corners);
    for (size_t k = 0; k < 3; ++k) {
      facts.welded_vertices[k] = welded[static_cast<size_t>(vertices[k])];
    }
    facts.welded = !has_repetition(facts.welded_vertices);
  }
}

struct UvBox {
  Texel low = {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Texel high = {-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
};

UvBox uv_box_of_slot(const Analysis& analysis, int64_t slot) {
  UvBox box;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    if (!analysis.faces[f].raw || analysis.model.faces[f].slot != slot) continue;
    for (const std::optional<Uv>& uv : analysis.model.faces[f].uvs) {
      for (size_t i = 0; uv && i < 2; ++i) {
        box.low[i] = std::min(box.low[i], static_cast<double>((*uv)[i]));
        box.high[i] = std::max(box.high[i], static_cast<double>((*uv)[i]));
      }
    }
  }
  return box;
}

Texel shift_of_slot(const Analysis& analysis, int64_t slot) {
  const UvBox box = uv_box_of_slot(analysis, slot);
  const auto outside = [&](size_t i) {
    const double centre = (box.low[i] + box.high[i]) / 2;
    return centre < 0 || centre > 1;
  };
  if (!outside(0) && !outside(1)) return {0, 0};
  return {-std::floor(box.low[0]), -std::floor(box.low[1])};
}

void place_on_slot(const Face& face, const Slot& slot, const Texel& shift, FaceFacts& facts) {
  facts.has_uv_triangle =
      slot.size && std::all_of(face.uvs.begin(), face.uvs.end(),
                               [](const std::optional<Uv>& uv) { return uv.has_value(); });
  if (!facts.has_uv_triangle) return;
  for (size_t k = 0; k < 3; ++k) {
    const auto [u, v] = *face.uvs[k];
    facts.shifted_uvs[k] = {u + shift[0], v + shift[1]};
    facts.texels[k] = {facts.shifted_uvs[k][0] * slot.size->first,
                       facts.shifted_uvs[k][1] * slot.size->second};
    for (const double t : facts.texels[k]) facts.uv_far |= std::abs(t) > 0x1p30;
  }
  facts.signed_uv_area = signed_texel_area(facts.texels);
}

void place_uvs(Analysis& analysis) {
  std::vector<Texel> shifts;
  for (size_t slot = 0; slot < analysis.model.slots.size(); ++slot) {
    shifts.push_back(shift_of_slot(analysis, static_cast<int64_t>(slot)));
  }
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const Face& face = analysis.model.faces[f];
    if (!analysis.faces[f].welded || !face.slot) continue;
    const auto slot = static_cast<size_t>(*face.slot);
    place_on_slot(face, analysis.model.slots[slot], shifts[slot], analysis.faces[f]);
  }
}

void split_into_uv_vertices(Analysis& analysis) {
  using UvVertex = std::tuple<int64_t, std::optional<Uv>, std::optional<int64_t>>;
  std::map<UvVertex, int64_t> ids;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    FaceFacts& facts = analysis.faces[f];
    const Face& face = analysis.model.faces[f];
    for (size_t k = 0; facts.welded && k < 3; ++k) {
      std::optional<Uv> uv = face.uvs[k];
      if (uv) uv = Uv{(*uv)[0] + 0.0F, (*uv)[1] + 0.0F};
      const auto next = static_cast<int64_t>(ids.size());
      facts.uv_vertices[k] =
          ids.try_emplace({facts.welded_vertices[k], uv, face.slot}, next).first->second;
    }
  }
}

void add_edges(const Triple& vertices, int64_t face, EdgeMap& edges) {
  for (int corner = 0; corner < 3; ++corner) {
    const EdgeKey key = edge_key(vertices, corner);
    const bool forward = key.first == vertices[static_cast<size_t>(corner)];
    edges[key].push_back({face, corner, forward});
  }
}

void collect_edges(Analysis& analysis) {
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const FaceFacts& facts = analysis.faces[f];
    const auto face = static_cast<int64_t>(f);
    if (facts.raw) add_edges(analysis.model.faces[f].vertices, face, analysis.raw_edges);
    if (!facts.welded) continue;
    add_edges(facts.welded_vertices, face, analysis.welded_edges);
    add_edges(facts.uv_vertices, face, analysis.uv_edges);
  }
}

void number_charts(Analysis& analysis) {
  Sets sets = face_components(analysis.uv_edges, analysis.faces.size());
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    if (analysis.faces[f].welded) analysis.faces[f].chart = sets.find(static_cast<int64_t>(f));
  }
}

}  // namespace

bool has_both_areas(const FaceFacts& face) {
  return face.area != 0 && face.signed_uv_area != 0;
}

int64_t count_boundary(const EdgeMap& edges) {
  return std::count_if(edges.begin(), edges.end(),
                       [](const auto& edge) { return edge.second.size() == 1; });
}

EdgeKey edge_key(const Triple& vertices, int corner) {
  const auto k = static_cast<size_t>(corner);
  return std::minmax({vertices[k], vertices[(k + 1) % 3]});
}

Analysis analyse(Model model) {
  Analysis analysis;
  analysis.faces.resize(model.faces.size());
  analysis.model = std::move(model);
  sort_out_levels(analysis);
  place_uvs(analysis);
  split_into_uv_vertices(analysis);
  collect_edges(analysis);
  number_charts(analysis);
  return analysis;
}

}  // namespace atlasgauge::oracle
