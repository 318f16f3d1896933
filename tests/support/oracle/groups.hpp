#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "tests/support/oracle/levels.hpp"

// Faces and vertices that belong together.
namespace atlasgauge::oracle {

// Disjoint sets, each named by its smallest member.
class Sets {
 public:
  explicit Sets(size_t count) : parent_(count) { std::iota(parent_.begin(), parent_.end(), 0); }

  int64_t find(int64_t x) {
    while (parent(x) != x) x = parent(x) = parent(parent(x));
    return x;
  }

  void unite(int64_t x, int64_t y) {
    const auto [low, high] = std::minmax({find(x), find(y)});
    parent(high) = low;
  }

 private:
  int64_t& parent(int64_t x) { return parent_[static_cast<size_t>(x)]; }

  std::vector<int64_t> parent_;
};

Sets face_components(const EdgeMap& edges, size_t face_count);

// Which faces to flip so that all run coherently across the edges of exactly two faces, the first
// face of each class so joined staying as it is; and the faces where that is impossible.
struct Coherence {
  std::vector<std::optional<bool>> flipped;
  std::vector<int64_t> contradictions;
};

Coherence make_coherent(const EdgeMap& edges, size_t face_count);

}  // namespace atlasgauge::oracle
