#include "stream/raster/scalar_raster.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "stream/raster/row_spans.hpp"

namespace atlasgauge {
namespace {

/// Boxes of at most so many texels a side are tested centre by centre, eight at once: that takes
/// less time than the quotients of RowSpans, and has no branch that depends on the shape. All
/// products fit in 32 bits.
constexpr std::int64_t kSmallSide = 16;
constexpr std::size_t kLanes = TexelTile::kPadding;

/// Whether a triangle is small, and ends with its box of centres on the right: lanes may run over
/// the end of the window, where it must cover nothing.
bool is_small(const SnappedTriangle& triangle, const TexelRect& box) {
  const auto [low_x, high_x] = std::minmax({triangle.x[0], triangle.x[1], triangle.x[2]});
  const auto [low_y, high_y] = std::minmax({triangle.y[0], triangle.y[1], triangle.y[2]});
  return std::max(high_x - low_x, high_y - low_y) <= 256 * kSmallSide &&
         first_centre(high_x) == box.x1;
}

/// One side of a triangle: negative where a centre lies outside. Centres are counted from the first
/// one in the box.
struct HalfSpace {
  std::int32_t at_origin;  ///< at the first centre
  std::int32_t per_texel;  ///< from a centre to the next on its right
  std::int32_t per_row;    ///< from row to row

  /// The triangle lies left of the edge from (ax, ay) to (bx, by).
  HalfSpace(std::int32_t ax, std::int32_t ay, std::int32_t bx, std::int32_t by) {
    const std::int32_t dx = bx - ax, dy = by - ay;
    const bool inclusive = dy < 0 || (dy == 0 && dx > 0);
    at_origin = dy * ax - dx * ay - (inclusive ? 0 : 1);
    per_texel = -256 * dy;
    per_row = 256 * dx;
  }
};

using Sides = std::array<HalfSpace, 3>;
/// The values of the three sides at one centre.
using SideValues = std::array<std::int32_t, 3>;
/// What they change by from a centre to those right of it.
using LaneOffsets = std::array<std::array<std::int32_t, kLanes>, 3>;

LaneOffsets lane_offsets(const Sides& sides) {
  LaneOffsets offsets;
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      offsets[k][i] = static_cast<std::int32_t>(i) * sides[k].per_texel;
    }
  }
  return offsets;
}

/// Adds a triangle to those of kLanes texels that lie inside; the others are written back as they
/// were. In masks, not in conditions: so all lanes are worked on at once.
void cover_lanes(std::uint32_t* charts, std::uint32_t* counts, const LaneOffsets& offsets,
                 const SideValues& first, std::uint32_t chart_plus_one) {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const std::int32_t signs =
        (first[0] + offsets[0][i]) | (first[1] + offsets[1][i]) | (first[2] + offsets[2][i]);
    const auto inside = static_cast<std::uint32_t>(~(signs >> 31));
    const auto before = static_cast<std::int32_t>(charts[i]);
    const std::uint32_t differs =
        (before != 0 ? ~0U : 0U) & (before != static_cast<std::int32_t>(chart_plus_one) ? ~0U : 0U);
    charts[i] = static_cast<std::uint32_t>(
        std::max(before, static_cast<std::int32_t>(chart_plus_one & inside)));
    counts[i] = (counts[i] + (inside & 1)) | (differs & inside & TexelTile::kSeveralCharts);
  }
}

/// A box of one column, as most are on the higher mip levels.
void draw_column(const Sides& sides, SideValues row, const TexelRect& box,
                 std::uint32_t chart_plus_one, TexelTile& tile) {
  for (std::int64_t y = box.y0; y < box.y1; ++y) {
    if ((row[0] | row[1] | row[2]) >= 0) {
      tile.cover(tile.index(box.x0, y), 1, chart_plus_one, false);
    }
    for (std::size_t k = 0; k < 3; ++k) row[k] += sides[k].per_row;
  }
}

void draw_lanes(const Sides& sides, SideValues row, const TexelRect& box,
                std::uint32_t chart_plus_one, TexelTile& tile) {
  constexpr auto kStep = static_cast<std::int32_t>(kLanes);
  const LaneOffsets offsets = lane_offsets(sides);
  const bool is_wide = box.width() > kStep;
  std::size_t at = tile.index(box.x0, box.y0);
  for (std::int64_t y = box.y0; y < box.y1; ++y, at += tile.stride()) {
    cover_lanes(tile.charts() + at, tile.counts() + at, offsets, row, chart_plus_one);
    if (is_wide) {
      const SideValues right{row[0] + kStep * sides[0].per_texel,
                             row[1] + kStep * sides[1].per_texel,
                             row[2] + kStep * sides[2].per_texel};
      cover_lanes(tile.charts() + at + kLanes, tile.counts() + at + kLanes, offsets, right,
                  chart_plus_one);
    }
    for (std::size_t k = 0; k < 3; ++k) row[k] += sides[k].per_row;
  }
}

void draw_small(const SnappedTriangle& triangle, const TexelRect& box, TexelTile& tile) {
  SideValues x, y;  // from the first centre
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = static_cast<std::int32_t>(triangle.x[k] - (256 * box.x0 + 128));
    y[k] = static_cast<std::int32_t>(triangle.y[k] - (256 * box.y0 + 128));
  }
  const std::int32_t area = (x[1] - x[0]) * (y[2] - y[0]) - (x[2] - x[0]) * (y[1] - y[0]);
  if (area == 0) return;
  const std::size_t b = area > 0 ? 1 : 2, c = 3 - b;  // counter-clockwise
  const Sides sides{HalfSpace(x[0], y[0], x[b], y[b]), HalfSpace(x[b], y[b], x[c], y[c]),
                    HalfSpace(x[c], y[c], x[0], y[0])};
  const SideValues row{sides[0].at_origin, sides[1].at_origin, sides[2].at_origin};
  const auto draw = box.width() == 1 ? draw_column : draw_lanes;
  draw(sides, row, box, triangle.chart + 1, tile);
}

void cover_row(std::uint32_t* charts, std::uint32_t* counts, std::int64_t texels,
               std::uint32_t chart_plus_one) {
  for (std::int64_t i = 0; i < texels; ++i) {
    const std::uint32_t before = charts[i];
    const bool differs = (before != 0) & (before != chart_plus_one);
    charts[i] = std::max(before, chart_plus_one);
    counts[i] = (counts[i] + 1) | (differs ? TexelTile::kSeveralCharts : 0);
  }
}

void draw_large(const SnappedTriangle& triangle, TexelTile& tile) {
  RowSpans(tile.window()).visit(triangle, [&](std::int64_t y, std::int64_t x0, std::int64_t x1) {
    const std::size_t at = tile.index(x0, y);
    cover_row(tile.charts() + at, tile.counts() + at, x1 - x0, triangle.chart + 1);
  });
}

}  // namespace

void ScalarRaster::draw(std::span<const SnappedTriangle> triangles, TexelTile& tile) {
  for (const SnappedTriangle& triangle : triangles) {
    const TexelRect box = centres_in_box(triangle, tile.window());
    if (box.empty()) continue;
    ++tally_.scalar;
    is_small(triangle, box) ? draw_small(triangle, box, tile) : draw_large(triangle, tile);
  }
}

}  // namespace atlasgauge
