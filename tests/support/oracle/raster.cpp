#include "tests/support/oracle/raster.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "tests/support/oracle/statistics.hpp"

namespace atlasgauge::oracle {
namespace {

using nlohmann::json;

// Coordinates reach 2^38, so products of their differences need more than 64 bits.
__extension__ typedef __int128 Int128;

constexpr int64_t kUnits = 256;  // of a snapped coordinate, in a texel

using Point = std::array<int64_t, 2>;  // in units
using Corners = std::array<Point, 3>;

// What covers one texel.
struct Cover {
  int64_t triangles = 0;
  int64_t lowest_chart = 0;
  int64_t highest_chart = 0;

  void add(int64_t chart) {
    lowest_chart = triangles == 0 ? chart : std::min(lowest_chart, chart);
    highest_chart = triangles == 0 ? chart : std::max(highest_chart, chart);
    ++triangles;
  }
};

struct Grid {
  int64_t width;
  int64_t height;
  std::vector<Cover> covers;

  Cover& at(int64_t x, int64_t y) { return covers[static_cast<size_t>(y * width + x)]; }
  const Cover& at(int64_t x, int64_t y) const { return covers[static_cast<size_t>(y * width + x)]; }
  bool contains(int64_t x, int64_t y) const { return x >= 0 && x < width && y >= 0 && y < height; }
};

int64_t snapped(double shifted_uv, int64_t side) {
  return std::llrint(shifted_uv * static_cast<double>(side) * kUnits);
}

// Twice the signed area.
Int128 doubled_area(const Point& a, const Point& b, const Point& c) {
  return Int128{b[0] - a[0]} * (c[1] - a[1]) - Int128{c[0] - a[0]} * (b[1] - a[1]);
}

// Whether the triangle that lies to the left of a side has the point, as far as the side can tell:
// of points on a side, those on one that runs down, or level and to the right, are inside.
bool has(const Point& from, const Point& to, const Point& point) {
  const Int128 area = doubled_area(from, to, point);
  if (area != 0) return area > 0;
  return to[1] < from[1] || (to[1] == from[1] && to[0] > from[0]);
}

// Texels whose centres may lie in the range of one coordinate, clipped to the texture.
std::pair<int64_t, int64_t> texel_range(const Corners& corners, size_t axis, int64_t side) {
  const auto [low, high] = std::minmax({corners[0][axis], corners[1][axis], corners[2][axis]});
  const auto texel = [](int64_t units) { return units >> 8; };  // rounds down
  return {std::max<int64_t>(0, texel(low)), std::min(side - 1, texel(high))};
}

void draw(Corners corners, int64_t chart, Grid& grid) {
  const Int128 area = doubled_area(corners[0], corners[1], corners[2]);
  if (area == 0) return;
  if (area < 0) std::swap(corners[1], corners[2]);
  const auto& [a, b, c] = corners;
  const auto [left, right] = texel_range(corners, 0, grid.width);
  const auto [bottom, top] = texel_range(corners, 1, grid.height);
  for (int64_t y = bottom; y <= top; ++y) {
    for (int64_t x = left; x <= right; ++x) {
      const Point centre = {x * kUnits + kUnits / 2, y * kUnits + kUnits / 2};
      if (has(a, b, centre) && has(b, c, centre) && has(c, a, centre)) grid.at(x, y).add(chart);
    }
  }
}

Grid raster(const Analysis& analysis, int64_t slot, Size size) {
  Grid grid{size.first, size.second, {}};
  grid.covers.resize(static_cast<size_t>(grid.width * grid.height));
  for (size_t f = 0; f < analysis.faces.size(); ++f) {
    const FaceFacts& face = analysis.faces[f];
    if (analysis.model.faces[f].slot != slot || !face.has_uv_triangle || face.uv_far) continue;
    Corners corners;
    for (size_t k = 0; k < 3; ++k) {
      const auto [u, v] = face.shifted_uvs[k];
      corners[k] = {snapped(u, grid.width), snapped(v, grid.height)};
    }
    draw(corners, face.chart, grid);
  }
  return grid;
}

template <class Predicate>
bool any_neighbour(const Grid& grid, int64_t x, int64_t y, Predicate predicate) {
  for (int64_t j = y - 1; j <= y + 1; ++j) {
    for (int64_t i = x - 1; i <= x + 1; ++i) {
      const bool is_itself = i == x && j == y;
      if (!is_itself && grid.contains(i, j) && predicate(grid.at(i, j))) return true;
    }
  }
  return false;
}

bool is_covered(const Cover& cover) {
  return cover.triangles > 0;
}

bool on_rim(const Grid& grid, int64_t x, int64_t y) {
  return x == 0 || y == 0 || x == grid.width - 1 || y == grid.height - 1;
}

// A texel belongs to the highest chart that covers it.
void count_covered_texel(const Grid& grid, int64_t x, int64_t y, LevelCounts& counts) {
  const Cover& cover = grid.at(x, y);
  const auto is_bare = [](const Cover& other) { return !is_covered(other); };
  const auto is_of_another_chart = [&](const Cover& other) {
    return is_covered(other) && other.highest_chart != cover.highest_chart;
  };
  const bool again = cover.triangles > 1;
  const bool several_charts = cover.lowest_chart != cover.highest_chart;
  counts.covered += 1;
  counts.total += cover.triangles;
  counts.overwritten += again;
  counts.lost += cover.triangles - 1;
  counts.boundary += on_rim(grid, x, y) || any_neighbour(grid, x, y, is_bare);
  counts.clashes += any_neighbour(grid, x, y, is_of_another_chart);
  counts.covered_again_by_the_same_chart += again && !several_charts;
  counts.covered_by_several_charts += several_charts;
}

LevelCounts count(const Grid& grid, Size size) {
  LevelCounts counts;
  counts.size = size;
  for (int64_t y = 0; y < grid.height; ++y) {
    for (int64_t x = 0; x < grid.width; ++x) {
      const bool covered = is_covered(grid.at(x, y));
      counts.bilinear += covered || any_neighbour(grid, x, y, is_covered);
      if (covered) count_covered_texel(grid, x, y, counts);
    }
  }
  return counts;
}

SlotCounts raster_slot(const Analysis& analysis, int64_t slot, Size size) {
  SlotCounts levels;
  while (size.first > 0 && size.second > 0) {
    levels.push_back(count(raster(analysis, slot, size), size));
    size = {size.first / 2, size.second / 2};
  }
  return levels;
}

json level_json(const LevelCounts& level, bool counts_texels) {
  json object = {{"rw", level.size.first}, {"rh", level.size.second}};
  const auto put = [&](const char* key, int64_t count) {
    object[key] = counts_texels ? json(count) : json(nullptr);
  };
  put("totalTexels", level.total);
  put("totalTexels_bilinear", level.bilinear);
  put("overwrittenTexels", level.overwritten);
  put("lostTexels", level.lost);
  put("boundaryTexels", level.boundary);
  put("texelClashes", level.clashes);
  return object;
}

json occupancy(const std::optional<Coverage>& coverage) {
  if (!coverage) return nullptr;
  return ratio(coverage->covered, coverage->of_covered_slots);
}

}  // namespace

std::vector<SlotCounts> raster_slots(const Analysis& analysis) {
  std::vector<SlotCounts> slots;
  for (const Slot& slot : analysis.model.slots) {
    const auto number = static_cast<int64_t>(slots.size());
    slots.push_back(slot.size ? raster_slot(analysis, number, *slot.size) : SlotCounts{});
  }
  return slots;
}

std::optional<Coverage> coverage_of(const Analysis& analysis,
                                    const std::vector<SlotCounts>& slots) {
  Coverage sum;
  for (const SlotCounts& levels : slots) {
    if (levels.empty()) continue;
    const LevelCounts& level = levels.front();
    sum.covered += level.covered;
    sum.of_all_slots += level.texels();
    if (level.covered > 0) sum.of_covered_slots += level.texels();
  }
  if (!analysis.model.counts_texels || sum.covered == 0) return std::nullopt;
  return sum;
}

void report_raster(json& report, const Analysis& analysis, const std::vector<SlotCounts>& slots) {
  const bool counts_texels = analysis.model.counts_texels;
  int64_t within_chart = 0, between_charts = 0;
  for (size_t slot = 0; slot < slots.size(); ++slot) {
    json& list = report["texture_" + std::to_string(slot)] = json::array();
    for (const LevelCounts& level : slots[slot]) list.push_back(level_json(level, counts_texels));
    if (slots[slot].empty()) continue;
    within_chart += slots[slot].front().covered_again_by_the_same_chart;
    between_charts += slots[slot].front().covered_by_several_charts;
  }
  report["overlap_within_chart_texels"] = counts_texels ? json(within_chart) : json(nullptr);
  report["overlap_between_charts_texels"] = counts_texels ? json(between_charts) : json(nullptr);
  report["occupancy"] = occupancy(coverage_of(analysis, slots));
}

}  // namespace atlasgauge::oracle
