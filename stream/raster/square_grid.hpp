#pragma once

#include <algorithm>
#include <cstdint>

#include "stream/mesh/triangle.hpp"
#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {

/// A level cut into squares of some texels a side, column by column and row by row from its lower
/// left corner; those at its other sides may be cut off.
class SquareGrid {
 public:
  /// How far beyond a square triangles matter to it, in texels.
  struct Reach {
    double x, y;
  };

  SquareGrid(const LevelSize& size, std::int64_t side, Reach reach);

  std::int64_t columns() const { return columns_; }
  std::int64_t rows() const { return rows_; }

  /// Calls use(column, row) for every square to which the triangle may matter: no more than a few
  /// beside those to which it does, however large or thin it is. `corner` in texels of the level.
  template <class Use>
  void visit_touched(const Texel (&corner)[3], Use use) const;

 private:
  /// Columns or rows [first, last].
  struct Range {
    std::int64_t first, last;
    bool empty() const { return first > last; }
  };

  static Range squares_between(double low, double high, double side, std::int64_t squares) {
    if (high < 0) return {0, -1};
    // Truncation is floor here, without a call.
    const auto last = static_cast<double>(squares - 1);
    return {static_cast<std::int64_t>(std::min(last + 1, std::max(0.0, low / side))),
            static_cast<std::int64_t>(std::min(last, high / side))};
  }
  Range columns_between(double low_x, double high_x) const {
    return squares_between(low_x - reach_.x, high_x + reach_.x, side_, columns_);
  }
  Range rows_between(double low_y, double high_y) const {
    return squares_between(low_y - reach_.y, high_y + reach_.y, side_, rows_);
  }
  /// The columns to which the part of the triangle near one row may matter.
  Range columns_in_row(std::int64_t row, const Texel (&corner)[3]) const;

  double side_;
  std::int64_t columns_, rows_;
  Reach reach_;
};

template <class Use>
void SquareGrid::visit_touched(const Texel (&corner)[3], Use use) const {
  const auto [low_x, high_x] = std::minmax({corner[0].x, corner[1].x, corner[2].x});
  const auto [low_y, high_y] = std::minmax({corner[0].y, corner[1].y, corner[2].y});
  const Range columns = columns_between(low_x, high_x);
  const Range rows = rows_between(low_y, high_y);
  if (columns.empty() || rows.empty()) return;
  const bool few = columns.last - columns.first <= 1 || rows.last == rows.first;
  for (std::int64_t row = rows.first; row <= rows.last; ++row) {
    const Range in_row = few ? columns : columns_in_row(row, corner);
    for (std::int64_t column = in_row.first; column <= in_row.last; ++column) use(column, row);
  }
}

}  // namespace atlasgauge
