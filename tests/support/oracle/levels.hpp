#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "tests/support/oracle/model.hpp"

// The raw, the welded and the uv level of a model.
namespace atlasgauge::oracle {

using Texel = std::array<double, 2>;

// Everything that is known of one face once the levels are sorted out.
struct FaceFacts {
  bool degenerate = false;
  bool non_finite = false;
  bool raw = false;     // takes part in the raw level
  bool welded = false;  // takes part in the welded and the uv level
  double area = 0;
  bool has_uv_triangle = false;
  bool uv_far = false;
  std::array<Texel, 3> shifted_uvs{};  // by the whole-texture shift of the slot
  std::array<Texel, 3> texels{};
  double signed_uv_area = 0;
  Triple welded_vertices{};
  Triple uv_vertices{};
  int64_t chart = -1;
};

struct EdgeUse {
  int64_t face;
  int corner;    // the edge runs from this corner to the next
  bool forward;  // from the smaller to the larger of its vertices
};

using EdgeKey = std::pair<int64_t, int64_t>;
using EdgeMap = std::map<EdgeKey, std::vector<EdgeUse>>;

struct Analysis {
  Model model;
  std::vector<FaceFacts> faces;
  EdgeMap raw_edges;
  EdgeMap welded_edges;
  EdgeMap uv_edges;
};

// Faces that a ratio of the two areas exists for.
bool has_both_areas(const FaceFacts& face);

Analysis analyse(Model model);

// The edge from a corner of a face to the next.
EdgeKey edge_key(const Triple& vertices, int corner);

int64_t count_boundary(const EdgeMap& edges);

}  // namespace atlasgauge::oracle
