#pragma once

#include <cmath>
#include <cstdint>

// The half-edges that peers sort. C++14, for STXXL's sake.

namespace atlasgauge {

struct PeerHalfEdge {
  std::uint32_t lo, hi;
  std::uint32_t face;
  std::uint32_t side;

  std::uint32_t key() const { return lo; }
};

inline bool operator<(const PeerHalfEdge& a, const PeerHalfEdge& b) {
  return a.lo != b.lo ? a.lo < b.lo : a.hi < b.hi;
}

/// The half-edges of a ground of side x side quads, two faces each, in mesh order.
class PeerGround {
 public:
  explicit PeerGround(std::uint64_t about_faces)
      : side_(static_cast<std::uint32_t>(std::sqrt(static_cast<double>(about_faces) / 2)) + 1) {}

  std::uint64_t half_edges() const { return 6 * std::uint64_t{side_} * side_; }
  std::uint64_t edges() const { return 3 * std::uint64_t{side_} * side_ + 2 * side_; }
  std::uint32_t vertices() const { return (side_ + 1) * (side_ + 1); }

  template <class Use>
  void for_each(Use use) const {
    std::uint32_t face = 0;
    for (std::uint32_t x = 0; x < side_; ++x) {
      for (std::uint32_t y = 0; y < side_; ++y) {
        const std::uint32_t v = x * (side_ + 1) + y, right = v + side_ + 1;
        triangle(v, right, right + 1, face++, use);
        triangle(v, right + 1, v + 1, face++, use);
      }
    }
  }

 private:
  template <class Use>
  static void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t face,
                       Use& use) {
    use(half_edge(a, b, face, 0));
    use(half_edge(b, c, face, 1));
    use(half_edge(c, a, face, 2));
  }
  static PeerHalfEdge half_edge(std::uint32_t a, std::uint32_t b, std::uint32_t face,
                                std::uint32_t side) {
    return a < b ? PeerHalfEdge{a, b, face, side} : PeerHalfEdge{b, a, face, side};
  }

  std::uint32_t side_;
};

/// Counts the edges of sorted half-edges.
class EdgeCount {
 public:
  void add(std::uint32_t lo, std::uint32_t hi) {
    if (lo != lo_ || hi != hi_) ++count_;
    lo_ = lo;
    hi_ = hi;
  }
  std::uint64_t count() const { return count_; }

 private:
  std::uint32_t lo_ = ~0U, hi_ = ~0U;
  std::uint64_t count_ = 0;
};

}  // namespace atlasgauge
