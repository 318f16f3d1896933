#include "stream/raster/square_grid.hpp"

#include <limits>

namespace atlasgauge {
namespace {

std::int64_t squares_along(std::int64_t texels, std::int64_t side) {
  return (texels + side - 1) / side;
}

}  // namespace

SquareGrid::SquareGrid(const LevelSize& size, std::int64_t side, Reach reach)
    : side_(static_cast<double>(side)),
      columns_(squares_along(size.width, side)),
      rows_(squares_along(size.height, side)),
      reach_(reach) {}

SquareGrid::Range SquareGrid::columns_in_row(std::int64_t row, const Texel (&corner)[3]) const {
  const double bottom = static_cast<double>(row) * side_ - reach_.y;
  const double top = bottom + side_ + 2 * reach_.y;
  double low_x = std::numeric_limits<double>::infinity(), high_x = -low_x;
  const auto add = [&](double x) {
    low_x = std::min(low_x, x);
    high_x = std::max(high_x, x);
  };
  for (int k = 0; k < 3; ++k) {
    const Texel &a = corner[k], &b = corner[(k + 1) % 3];
    if (a.y >= bottom && a.y <= top) add(a.x);
    for (const double y : {bottom, top}) {
      if ((a.y < y) != (b.y < y)) add(a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)));
    }
  }
  if (low_x > high_x) return {0, -1};
  return columns_between(low_x, high_x);
}

}  // namespace atlasgauge
