#include "tests/support/oracle/groups.hpp"

#include <cstddef>

namespace atlasgauge::oracle {
namespace {

struct Neighbour {
  int64_t face;
  bool same_direction;
};

std::vector<std::vector<Neighbour>> manifold_neighbours(const EdgeMap& edges, size_t face_count) {
  std::vector<std::vector<Neighbour>> neighbours(face_count);
  for (const auto& [key, uses] : edges) {
    if (uses.size() != 2) continue;
    const bool same = uses[0].forward == uses[1].forward;
    neighbours[static_cast<size_t>(uses[0].face)].push_back({uses[1].face, same});
    neighbours[static_cast<size_t>(uses[1].face)].push_back({uses[0].face, same});
  }
  return neighbours;
}

}  // namespace

Sets face_components(const EdgeMap& edges, size_t face_count) {
  Sets sets(face_count);
  for (const auto& [key, uses] : edges) {
    for (const EdgeUse& use : uses) sets.unite(use.face, uses.front().face);
  }
  return sets;
}

Coherence make_coherent(const EdgeMap& edges, size_t face_count) {
  const auto neighbours = manifold_neighbours(edges, face_count);
  Coherence result{std::vector<std::optional<bool>>(face_count), {}};
  for (size_t first = 0; first < face_count; ++first) {
    if (result.flipped[first]) continue;
    result.flipped[first] = false;
    std::vector<size_t> open = {first};
    while (!open.empty()) {
      const size_t face = open.back();
      open.pop_back();
      for (const Neighbour& neighbour : neighbours[face]) {
        const bool wanted = *result.flipped[face] != neighbour.same_direction;
        std::optional<bool>& other = result.flipped[static_cast<size_t>(neighbour.face)];
        if (other && *other != wanted) result.contradictions.push_back(neighbour.face);
        if (!other) open.push_back(static_cast<size_t>(neighbour.face));
        if (!other) other = wanted;
      }
    }
  }
  return result;
}

}  // namespace atlasgauge::oracle
