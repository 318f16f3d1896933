#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include "stream/raster/raster.hpp"

// A texel belongs to a triangle when, with C its centre, the line of C's row crosses the triangle's
// border left of C or in C, and again right of C; and when C is not below the lowest vertex, but
// below the highest. This is the rule of the half-spaces, left and lower edges inclusive, as the
// two crossings are rounded up to the next centre by the same formula for both: ceil(q) for the
// position q of the crossing, counted in texel centres. A shared edge gives the same q to both of
// its triangles, so no texel between them is covered twice or not at all.

namespace atlasgauge {
namespace detail {

__extension__ typedef __int128 Int128;

/// Up to this far from the tile, in 1/256 texel, all products fit in 64 bits.
inline constexpr std::int64_t kNear = std::int64_t{1} << 29;

struct Point {
  std::int64_t x, y;
};

template <class Int>
Int floor_quotient(Int a, Int b) {
  const Int quotient = a / b;
  return a % b < 0 ? quotient - 1 : quotient;
}

/// Where the rows of texel centres cross an edge: ceil(N / D) with D = 256 h for an edge that rises
/// by h and runs by w, and N = h (x - 128) + w (row's y - y), kept as quotient and remainder of
/// N + D - 1.
template <class Int>
class Crossings {
 public:
  /// From `low` up to `high`, starting with `row`; `low` is below `high`.
  Crossings(const Point& low, const Point& high, std::int64_t row) {
    const Int rise = high.y - low.y;
    const Int run = high.x - low.x;
    divisor_ = 256 * rise;
    const Int numerator = rise * (low.x - 128) + run * (256 * row + 128 - low.y) + divisor_ - 1;
    crossing_ = floor_quotient(numerator, divisor_);
    remainder_ = numerator - crossing_ * divisor_;
    step_ = floor_quotient(run, rise);
    remainder_step_ = 256 * (run - step_ * rise);
  }

  /// The first centre at or right of the edge.
  std::int64_t texel() const { return static_cast<std::int64_t>(crossing_); }

  void next_row() {
    crossing_ += step_;
    remainder_ += remainder_step_;
    if (remainder_ < divisor_) return;
    remainder_ -= divisor_;
    ++crossing_;
  }

 private:
  Int divisor_, crossing_, remainder_, step_, remainder_step_;
};

}  // namespace detail

/// The rows of texels in a window that triangles cover.
class RowSpans {
 public:
  explicit RowSpans(const TexelRect& window) : window_(window) {}

  /// Calls cover(y, x0, x1) for every row y of the window in which the triangle covers the texels
  /// [x0, x1).
  template <class Cover>
  void visit(const SnappedTriangle& triangle, Cover cover) const {
    // Relative to the window, products are small.
    const std::int64_t left = 256 * window_.x0, bottom = 256 * window_.y0;
    detail::Point p[3];
    for (int k = 0; k < 3; ++k) p[k] = {triangle.x[k] - left, triangle.y[k] - bottom};
    if (p[1].y < p[0].y) std::swap(p[0], p[1]);
    if (p[2].y < p[1].y) std::swap(p[1], p[2]);
    if (p[1].y < p[0].y) std::swap(p[0], p[1]);
    const auto [low_x, high_x] = std::minmax({p[0].x, p[1].x, p[2].x});
    const std::int64_t first_row = std::max<std::int64_t>(0, first_centre(p[0].y));
    const std::int64_t end_row = std::min(window_.height(), first_centre(p[2].y));
    if (first_row >= end_row) return;
    const std::int64_t first = std::max<std::int64_t>(0, first_centre(low_x));
    if (first >= std::min(window_.width(), first_centre(high_x))) return;
    const std::int64_t middle_row = std::clamp(first_centre(p[1].y), first_row, end_row);
    const auto near = [](std::int64_t position) {
      return position >= -detail::kNear && position <= detail::kNear;
    };
    if (near(low_x) && near(high_x) && near(p[0].y) && near(p[2].y)) {
      visit_rows<std::int64_t>(p, first_row, middle_row, end_row, cover);
    } else {
      visit_rows<detail::Int128>(p, first_row, middle_row, end_row, cover);
    }
  }

 private:
  template <class Int, class Cover>
  void visit_rows(const detail::Point (&p)[3], std::int64_t first, std::int64_t middle,
                  std::int64_t end, Cover& cover) const {
    detail::Crossings<Int> whole(p[0], p[2], first);
    if (first < middle) {
      visit_between(whole, detail::Crossings<Int>(p[0], p[1], first), first, middle, cover);
    }
    if (middle < end) {
      visit_between(whole, detail::Crossings<Int>(p[1], p[2], middle), middle, end, cover);
    }
  }

  template <class Int, class Cover>
  void visit_between(detail::Crossings<Int>& whole, detail::Crossings<Int> part, std::int64_t first,
                     std::int64_t end, Cover& cover) const {
    for (std::int64_t row = first; row < end; ++row) {
      const auto [left, right] = std::minmax({whole.texel(), part.texel()});
      const std::int64_t from = std::max<std::int64_t>(0, left);
      const std::int64_t to = std::min(window_.width(), right);
      if (from < to) cover(window_.y0 + row, window_.x0 + from, window_.x0 + to);
      whole.next_row();
      part.next_row();
    }
  }

  TexelRect window_;
};

}  // namespace atlasgauge
