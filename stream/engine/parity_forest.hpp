#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace atlasgauge {

/// Union-find over [0, size) in which every node knows its parity against its root. The root of a
/// set is its smallest node. Four bytes a node: parent, parity to the parent, and, on roots,
/// whether some cycle of the set has odd parity.
class ParityForest {
 public:
  struct Root {
    std::uint32_t node;
    bool parity;
  };

  explicit ParityForest(std::size_t size) : words_(size) {
    std::iota(words_.begin(), words_.end(), 0U);
  }

  std::size_t size() const { return words_.size(); }
  bool is_root(std::uint32_t node) const { return parent(node) == node; }
  bool conflict(std::uint32_t root) const { return (words_[root] & kConflict) != 0; }

  Root find(std::uint32_t node) {
    bool parity = false;
    while (parent(node) != node) {
      const std::uint32_t up = parent(node);
      if (parent(up) != up) {  // path halving: hang the node on its grandparent
        words_[node] = parent(up) | ((words_[node] ^ words_[up]) & kParity);
      }
      parity ^= (words_[node] & kParity) != 0;
      node = parent(node);
    }
    return {node, parity};
  }

  void unite(std::uint32_t a, std::uint32_t b, bool parity) {
    const Root root_a = find(a);
    const Root root_b = find(b);
    const bool between = root_a.parity ^ root_b.parity ^ parity;
    if (root_a.node == root_b.node) {
      if (between) words_[root_a.node] |= kConflict;
      return;
    }
    const std::uint32_t low = std::min(root_a.node, root_b.node);
    const std::uint32_t high = std::max(root_a.node, root_b.node);
    words_[low] |= words_[high] & kConflict;
    words_[high] = low | (between ? kParity : 0);
  }

 private:
  static constexpr std::uint32_t kParity = std::uint32_t{1} << 30;
  static constexpr std::uint32_t kConflict = std::uint32_t{1} << 31;

  std::uint32_t parent(std::uint32_t node) const { return words_[node] & ~(kParity | kConflict); }

  std::vector<std::uint32_t> words_;
};

}  // namespace atlasgauge
