#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {

/// An undirected link between two nodes, `a` < `b` < 2^30. A link of parity 1 says that the two
/// ends are of opposite kind (two faces that run their common edge the same way). A link that is
/// not manifold joins its ends without a word on their kind.
class Link {
 public:
  Link() = default;
  Link(std::uint32_t a, std::uint32_t b, bool manifold = true, bool parity = false)
      : a_(std::min(a, b) | (manifold ? kFlag : 0)), b_(std::max(a, b) | (parity ? kFlag : 0)) {}

  std::uint32_t a() const { return a_ & ~kFlag; }
  std::uint32_t b() const { return b_ & ~kFlag; }
  bool manifold() const { return (a_ & kFlag) != 0; }
  bool parity() const { return (b_ & kFlag) != 0; }

 private:
  static constexpr std::uint32_t kFlag = std::uint32_t{1} << 31;
  std::uint32_t a_ = 0;
  std::uint32_t b_ = 0;
};

/// The label of a node: the smallest node of its component; whether the node is of the other kind
/// than that smallest one; and whether the component cannot be told into two kinds at all.
class Label {
 public:
  Label() = default;
  Label(std::uint32_t first, bool parity, bool conflict)
      : bits_(first | (parity ? kParity : 0) | (conflict ? kConflict : 0)) {}

  std::uint32_t first() const { return bits_ & ~(kParity | kConflict); }
  bool parity() const { return (bits_ & kParity) != 0; }
  bool conflict() const { return (bits_ & kConflict) != 0; }
  Label flipped(bool flip) const { return {first(), parity() != flip, conflict()}; }

 private:
  static constexpr std::uint32_t kParity = std::uint32_t{1} << 30;
  static constexpr std::uint32_t kConflict = std::uint32_t{1} << 31;
  std::uint32_t bits_ = 0;
};

/// Which links count, and whether their parity does.
enum class LinkRule {
  kAll,           ///< connectivity over all links; parities are ignored
  kManifoldOnly,  ///< connectivity and parity over the manifold links
};

/// Labels of the nodes [0, nodes), in node order. Consumes the links.
///
/// While four bytes a node fit in memory this is one union-find. Beyond, nodes are cut into ranges
/// that fit; each range unites what its own links join, and the roots that still have links to
/// other ranges, renumbered densely, are a smaller problem of the same kind. Where links are so
/// far-flung that a round removes less than a quarter, a star round comes first: by a coin per
/// node, tails hook onto their smallest head neighbour (one quarter of the linked nodes disappears
/// in expectation), so the number of rounds stays logarithmic for any graph. Roots keep the order
/// of their smallest node, so the way back is a sequential zip.
Spill<Label> label_nodes(const Engine& engine, Spill<Link> links, std::uint64_t nodes,
                         LinkRule rule);

/// The nodes that label_nodes can serve when so much memory is free: memory squared over 32 times
/// the block size.
std::uint64_t label_capacity(std::uint64_t memory_bytes, std::size_t block_bytes);

/// Components among labelled nodes, single nodes included.
std::uint64_t count_components(Spill<Label>& labels);

}  // namespace atlasgauge
