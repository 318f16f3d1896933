#include "tests/support/oracle/mesh_measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "tests/support/oracle/geometry.hpp"
#include "tests/support/oracle/groups.hpp"
#include "tests/support/oracle/statistics.hpp"

namespace atlasgauge::oracle {
namespace {

using nlohmann::json;

template <class Predicate>
int64_t count_faces(const Analysis& analysis, Predicate predicate) {
  return std::count_if(analysis.faces.begin(), analysis.faces.end(), predicate);
}

int64_t count_non_manifold(const EdgeMap& edges) {
  return std::count_if(edges.begin(), edges.end(),
                       [](const auto& edge) { return edge.second.size() > 2; });
}

Wide total_area(const Analysis& analysis) {
  Wide sum = 0;
  for (const FaceFacts& face : analysis.faces) sum += face.area;
  return sum;
}

Wide boundary_length(const Analysis& analysis) {
  std::vector<double> lengths;
  for (const auto& [edge, uses] : analysis.raw_edges) {
    if (uses.size() == 1) lengths.push_back(edge_length(analysis.model, edge));
  }
  return exact_sum(lengths);
}

double longest_side(const Model& model) {
  double longest = 0;
  for (size_t i = 0; i < 3; ++i) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Position& position : model.positions) {
      if (!is_finite(position)) continue;
      low = std::min(low, position[i]);
      high = std::max(high, position[i]);
    }
    longest = std::max(longest, high - low);
  }
  return longest;
}

std::map<int64_t, std::vector<int64_t>> faces_of_vertices(const Analysis& analysis) {
  std::map<int64_t, std::vector<int64_t>> faces_of;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    if (!analysis.faces[f].raw) continue;
    for (const int64_t v : analysis.model.faces[f].vertices) {
      faces_of[v].push_back(static_cast<int64_t>(f));
    }
  }
  return faces_of;
}

std::set<int64_t> vertices_on_non_manifold_edges(const EdgeMap& edges) {
  std::set<int64_t> vertices;
  for (const auto& [edge, uses] : edges) {
    if (uses.size() > 2) vertices.insert({edge.first, edge.second});
  }
  return vertices;
}

// Two faces at the vertex are in one fan when they share a further vertex, directly or by others.
size_t count_fans(const Model& model, int64_t vertex, const std::vector<int64_t>& faces) {
  std::map<int64_t, int64_t> first_at;
  Sets fans(faces.size());
  for (size_t i = 0; i < faces.size(); ++i) {
    const auto fan = static_cast<int64_t>(i);
    for (const int64_t other : model.faces[static_cast<size_t>(faces[i])].vertices) {
      if (other != vertex) fans.unite(fan, first_at.try_emplace(other, fan).first->second);
    }
  }
  std::set<int64_t> roots;
  for (size_t i = 0; i < faces.size(); ++i) roots.insert(fans.find(static_cast<int64_t>(i)));
  return roots.size();
}

int64_t count_non_manifold_vertices(const Analysis& analysis) {
  const std::set<int64_t> excluded = vertices_on_non_manifold_edges(analysis.raw_edges);
  int64_t count = 0;
  for (const auto& [vertex, faces] : faces_of_vertices(analysis)) {
    if (!excluded.contains(vertex) && count_fans(analysis.model, vertex, faces) > 1) ++count;
  }
  return count;
}

int64_t count_boundary_components(const Analysis& analysis) {
  Sets sets(analysis.model.positions.size());
  for (const auto& [edge, uses] : analysis.raw_edges) {
    if (uses.size() == 1) sets.unite(edge.first, edge.second);
  }
  std::set<int64_t> roots;
  for (const auto& [edge, uses] : analysis.raw_edges) {
    if (uses.size() == 1) roots.insert(sets.find(edge.first));
  }
  return static_cast<int64_t>(roots.size());
}

std::vector<int64_t> component_sizes(const Analysis& analysis) {
  Sets sets = face_components(analysis.raw_edges, analysis.faces.size());
  std::map<int64_t, int64_t> size_of;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    if (analysis.faces[f].raw) ++size_of[sets.find(static_cast<int64_t>(f))];
  }
  std::vector<int64_t> sizes;
  for (const auto& [root, size] : size_of) sizes.push_back(size);
  return sizes;
}

int64_t count_distinct_faces(const Analysis& analysis) {
  std::set<Triple> triples;
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    Triple triple = analysis.model.faces[f].vertices;
    std::sort(triple.begin(), triple.end());
    if (analysis.faces[f].raw) triples.insert(triple);
  }
  return static_cast<int64_t>(triples.size());
}

int64_t count_duplicate_positions(const std::vector<Position>& positions) {
  std::set<Position> distinct;
  int64_t duplicates = 0;
  for (const Position& position : positions) {
    const bool has_nan =
        std::any_of(position.begin(), position.end(), [](double x) { return std::isnan(x); });
    if (has_nan) continue;
    if (!distinct.insert(without_negative_zero(position)).second) ++duplicates;
  }
  return duplicates;
}

bool is_oriented(const EdgeMap& edges) {
  return std::all_of(edges.begin(), edges.end(), [](const auto& edge) {
    return edge.second.size() != 2 || edge.second[0].forward != edge.second[1].forward;
  });
}

void report_sizes(json& report, const Analysis& analysis) {
  const Wide area = total_area(analysis);
  const Wide boundary = boundary_length(analysis);
  const Wide side = longest_side(analysis.model);
  report["area"] = rounded(area);
  report["boundary_len"] = rounded(boundary);
  report["area_normalized"] = ratio(area, side * side);
  report["boundary_len_normalized"] = ratio(boundary, side);
}

void report_face_counts(json& report, const Analysis& analysis) {
  const int64_t raw = count_faces(analysis, [](const FaceFacts& f) { return f.raw; });
  report["fn"] = analysis.faces.size();
  report["fndup"] = raw - count_distinct_faces(analysis);
  report["fnzero"] = count_faces(analysis, [](const FaceFacts& f) { return f.raw && f.area == 0; });
  report["fndegen"] = count_faces(analysis, [](const FaceFacts& f) { return f.degenerate; });
  report["faces_nonfinite"] =
      count_faces(analysis, [](const FaceFacts& f) { return f.non_finite; });
  report["faces_invalid"] = analysis.model.invalid_polygons;
}

void report_topology(json& report, const Analysis& analysis) {
  const auto vertices = static_cast<int64_t>(faces_of_vertices(analysis).size());
  const auto edges = static_cast<int64_t>(analysis.raw_edges.size());
  const int64_t faces = count_faces(analysis, [](const FaceFacts& f) { return f.raw; });
  const std::vector<int64_t> components = component_sizes(analysis);
  const auto component_count = static_cast<int64_t>(components.size());
  const int64_t bad_edges = count_non_manifold(analysis.raw_edges);
  const int64_t bad_vertices = count_non_manifold_vertices(analysis);
  const int64_t loops = count_boundary_components(analysis);
  const bool manifold = bad_edges == 0 && bad_vertices == 0;
  report["vn"] = analysis.model.positions.size();
  report["vnunref"] = static_cast<int64_t>(analysis.model.positions.size()) - vertices;
  report["vndup"] = count_duplicate_positions(analysis.model.positions);
  report["en"] = edges;
  report["en_b"] = count_boundary(analysis.raw_edges);
  report["nonmanif_edge"] = bad_edges;
  report["nonmanif_vert"] = bad_vertices;
  report["connected_components"] = component_count;
  report["largest_component_fn"] =
      components.empty() ? 0 : *std::max_element(components.begin(), components.end());
  report["euler"] = vertices - edges + faces;
  report["boundary_components"] = loops;
  report["boundary_loops"] = manifold ? loops : -1;
  report["genus"] = manifold ? -(vertices + faces - edges + loops - 2 * component_count) / 2 : -1;
}

void report_orientation(json& report, const Analysis& analysis) {
  report["oriented"] = is_oriented(analysis.raw_edges);
  report["orientable"] =
      make_coherent(analysis.raw_edges, analysis.faces.size()).contradictions.empty();
}

}  // namespace

void report_mesh(json& report, const Analysis& analysis) {
  report["mesh"] = analysis.model.name;
  report_face_counts(report, analysis);
  report_topology(report, analysis);
  report_sizes(report, analysis);
  report_orientation(report, analysis);
}

}  // namespace atlasgauge::oracle
