#include "tests/support/random_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <vector>

namespace atlasgauge::oracle {
namespace {

using Point = std::array<double, 3>;
using UvPoint = std::array<double, 2>;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

// The distributions of the standard library differ between implementations; its engine does not.
// So does the order of evaluation: only braced lists may roll twice in one expression.
class Dice {
 public:
  explicit Dice(uint64_t seed) : engine_(seed) {}

  size_t below(size_t bound) { return static_cast<size_t>(engine_() % bound); }
  int between(int low, int high) {
    return low + static_cast<int>(below(static_cast<size_t>(high - low + 1)));
  }
  double unit() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  bool chance(double probability) { return unit() < probability; }

  template <class T>
  T pick(const std::vector<T>& choices) {
    return choices[below(choices.size())];
  }

  template <class T>
  void shuffle(std::vector<T>& items) {
    for (size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[below(i)]);
  }

 private:
  std::mt19937_64 engine_;
};

// A connected piece of surface in its own coordinates. The UVs of a vertex may differ from face to
// face, as where a closed strip is cut open.
struct PatchCorner {
  size_t vertex;
  UvPoint uv;
};

using PatchFace = std::vector<PatchCorner>;

struct Patch {
  std::vector<Point> points;
  std::vector<PatchFace> faces;
};

enum class UvIndex { kNone, kGood, kZero, kTooLarge, kTooSmall };

struct Corner {
  size_t vertex;
  size_t uv = 0;
  UvIndex uv_index = UvIndex::kGood;
};

struct Polygon {
  std::vector<Corner> corners;
  size_t material = 0;
};

struct Draft {
  std::vector<Point> positions;
  std::vector<UvPoint> uvs;
  std::vector<Polygon> polygons;
};

size_t triangle_count(const Draft& draft) {
  size_t count = 0;
  for (const Polygon& polygon : draft.polygons) count += polygon.corners.size() - 2;
  return count;
}

// ---- Shapes ----

enum class Closure { kOpen, kRing, kTwistedRing, kTorus };

struct Grid {
  size_t columns;
  size_t rows;
  Closure closure;

  size_t stored_columns() const { return closure == Closure::kOpen ? columns + 1 : columns; }
  size_t stored_rows() const { return closure == Closure::kTorus ? rows : rows + 1; }

  size_t vertex(size_t i, size_t j) const {
    if (i == columns && closure == Closure::kTwistedRing) j = rows - j;
    return (i % stored_columns()) * stored_rows() + j % stored_rows();
  }

  PatchCorner corner(size_t i, size_t j) const {
    return {vertex(i, j), {static_cast<double>(i) / 8, static_cast<double>(j) / 8}};
  }
};

void add_quad(Dice& dice, const std::array<PatchCorner, 4>& c, double quad_share, Patch& patch) {
  if (dice.chance(quad_share)) {
    patch.faces.push_back({c[0], c[1], c[2], c[3]});
  } else if (dice.chance(0.5)) {
    patch.faces.push_back({c[0], c[1], c[2]});
    patch.faces.push_back({c[0], c[2], c[3]});
  } else {
    patch.faces.push_back({c[0], c[1], c[3]});
    patch.faces.push_back({c[1], c[2], c[3]});
  }
}

Patch make_grid(Dice& dice) {
  const Closure closure = dice.pick<Closure>(
      {Closure::kOpen, Closure::kOpen, Closure::kRing, Closure::kTwistedRing, Closure::kTorus});
  const size_t least = closure == Closure::kOpen ? 1 : 3;
  const size_t least_rows = closure == Closure::kTorus ? 3 : 1;
  const Grid grid{least + dice.below(4), least_rows + dice.below(3), closure};
  const double height = dice.chance(0.5) ? 0.25 : 0;
  const double quad_share = dice.pick<double>({0, 0.3, 1});
  Patch patch;
  for (size_t i = 0; i < grid.stored_columns(); ++i) {
    for (size_t j = 0; j < grid.stored_rows(); ++j) {
      patch.points.push_back(
          {static_cast<double>(i) / 2, static_cast<double>(j) / 2, height * dice.between(-2, 2)});
    }
  }
  for (size_t i = 0; i < grid.columns; ++i) {
    for (size_t j = 0; j < grid.rows; ++j) {
      add_quad(dice,
               {grid.corner(i, j), grid.corner(i + 1, j), grid.corner(i + 1, j + 1),
                grid.corner(i, j + 1)},
               quad_share, patch);
    }
  }
  return patch;
}

// Vertices with UVs of their own, the plane projection: both sides of a solid share one region.
PatchCorner projected(const Patch& patch, size_t vertex) {
  const Point& p = patch.points[vertex];
  return {vertex, {p[0] / 4 + 0.25, p[1] / 4 + 0.25}};
}

void add_projected_face(const std::vector<size_t>& vertices, Patch& patch) {
  PatchFace face;
  for (const size_t vertex : vertices) face.push_back(projected(patch, vertex));
  patch.faces.push_back(face);
}

Patch make_solid(Dice& dice) {
  static const Patch tetrahedron_points = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {}};
  static const Patch octahedron_points = {
      {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, {}};
  static const Patch cube_points = {
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}}, {}};
  static const std::vector<std::vector<size_t>> tetrahedron = {
      {0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  static const std::vector<std::vector<size_t>> octahedron = {
      {0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  static const std::vector<std::vector<size_t>> cube = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                                                        {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
  const size_t kind = dice.below(3);
  Patch patch = kind == 0 ? tetrahedron_points : kind == 1 ? octahedron_points : cube_points;
  const auto& faces = kind == 0 ? tetrahedron : kind == 1 ? octahedron : cube;
  for (const auto& face : faces) add_projected_face(face, patch);
  return patch;
}

// Triangles around a point, or the ring alone as one polygon.
Patch make_fan(Dice& dice) {
  static const std::vector<Point> ring = {{1, 0, 0},  {1, 1, 0},   {0, 1, 0},  {-1, 1, 0},
                                          {-1, 0, 0}, {-1, -1, 0}, {0, -1, 0}, {1, -1, 0}};
  const size_t count = 3 + dice.below(6);
  Patch patch{{{0, 0, dice.pick<double>({0, 0.5})}}, {}};
  patch.points.insert(patch.points.end(), ring.begin(),
                      ring.begin() + static_cast<std::ptrdiff_t>(count));
  if (dice.chance(0.25)) {
    std::vector<size_t> polygon;
    for (size_t i = 1; i <= count; ++i) polygon.push_back(i);
    add_projected_face(polygon, patch);
    return patch;
  }
  const bool closed = dice.chance(0.5);
  for (size_t i = 1; i < count + (closed ? 1 : 0); ++i) {
    add_projected_face({0, i, i % count + 1}, patch);
  }
  return patch;
}

// Pages around one edge: a non-manifold edge from three pages on.
Patch make_book(Dice& dice) {
  Patch patch{{{0, 0, 0}, {0, 1, 0}}, {}};
  const size_t pages = 3 + dice.below(3);
  for (size_t i = 0; i < pages; ++i) {
    patch.points.push_back({1, 0.5 * static_cast<double>(i), dice.between(-1, 1) / 2.0});
    add_projected_face({0, 1, i + 2}, patch);
  }
  return patch;
}

// Triangles that share nothing but one vertex.
Patch make_bow_tie(Dice& dice) {
  Patch patch{{{0, 0, 0}}, {}};
  const size_t wings = 2 + dice.below(2);
  for (size_t i = 0; i < wings; ++i) {
    const double side = i % 2 == 0 ? 1 : -1;
    const double z = static_cast<double>(i / 2);
    patch.points.push_back({side, 0.5, z});
    patch.points.push_back({side, -0.5, z});
    add_projected_face({0, 2 * i + 1, 2 * i + 2}, patch);
  }
  return patch;
}

// Random triangles over few vertices.
Patch make_soup(Dice& dice) {
  Patch patch;
  const size_t points = 4 + dice.below(6);
  for (size_t i = 0; i < points; ++i) {
    patch.points.push_back(
        {dice.between(-2, 2) / 2.0, dice.between(-2, 2) / 2.0, dice.between(-1, 1) / 2.0});
  }
  const size_t faces = 3 + dice.below(12);
  for (size_t i = 0; i < faces; ++i) {
    const size_t a = dice.below(points), step = 1 + dice.below(points - 2);
    const size_t b = (a + step) % points;
    const size_t c = (a + step + 1 + dice.below(points - step - 1)) % points;
    add_projected_face({a, b, c}, patch);
  }
  return patch;
}

Patch make_patch(Dice& dice, bool manifold) {
  switch (manifold ? 3 + dice.below(5) : dice.below(8)) {
    case 0:
      return make_book(dice);
    case 1:
      return make_bow_tie(dice);
    case 2:
      return make_soup(dice);
    case 3:
      return make_fan(dice);
    case 4:
      return make_solid(dice);
    default:
      return make_grid(dice);
  }
}

// ---- Textures ----

using Size = std::pair<uint32_t, uint32_t>;

// Sizes are small, so that a naive raster of all of them is quick. Most textures of a model have
// the side that its UV lattices fit.
struct Textures {
  uint32_t common_side;
  std::map<std::string, Size> images;  // by the names that materials may give; absent: missing
  std::vector<std::string> names;
  std::optional<Size> size_option;
};

uint32_t any_side(Dice& dice) {
  return dice.pick<uint32_t>({1, 2, 3, 4, 5, 7, 8, 13, 16, 17, 31, 32, 33, 40});
}

uint32_t any_side_of(Dice& dice, uint32_t common_side) {
  return dice.chance(0.6) ? common_side : any_side(dice);
}

Size any_size(Dice& dice, uint32_t common_side) {
  if (dice.chance(0.02)) return {100 + any_side(dice), 3 * any_side(dice)};
  return {any_side_of(dice, common_side), any_side_of(dice, common_side)};
}

Textures make_textures(Dice& dice) {
  static const std::vector<std::string> all = {"a.png", "b two.png", "c.png", "d.png"};
  Textures textures;
  textures.common_side = any_side(dice);
  textures.names.assign(all.begin(), all.begin() + dice.pick<int>({0, 1, 2, 2, 3, 4}));
  for (const std::string& name : textures.names) {
    if (dice.chance(0.9)) textures.images[name] = any_size(dice, textures.common_side);
  }
  if (dice.chance(0.5)) textures.size_option = any_size(dice, textures.common_side);
  return textures;
}

// ---- Charts ----

void map_uvs(Patch& patch, const std::function<UvPoint(const PatchCorner&)>& map) {
  for (PatchFace& face : patch.faces) {
    for (PatchCorner& corner : face) corner.uv = map(corner);
  }
}

UvPoint any_offset(Dice& dice, int low, int high, double divisor) {
  return {dice.between(low, high) / divisor, dice.between(low, high) / divisor};
}

UvPoint lattice_uv(Dice& dice) {
  return any_offset(dice, 0, 16, 16);
}

// Each vertex gets one random UV: charts hold together, and fold.
void scatter_uvs(Dice& dice, Patch& patch) {
  std::vector<UvPoint> uvs;
  for (size_t i = 0; i < patch.points.size(); ++i) uvs.push_back(lattice_uv(dice));
  map_uvs(patch, [&](const PatchCorner& corner) { return uvs[corner.vertex]; });
}

// Each face becomes a chart of its own, somewhere.
void tear_uvs(Dice& dice, Patch& patch) {
  for (PatchFace& face : patch.faces) {
    const UvPoint offset = lattice_uv(dice);
    for (PatchCorner& corner : face) {
      corner.uv = {corner.uv[0] / 2 + offset[0], corner.uv[1] / 2 + offset[1]};
    }
  }
}

void scale_uvs(double u_factor, double v_factor, Patch& patch) {
  map_uvs(patch, [&](const PatchCorner& corner) {
    return UvPoint{corner.uv[0] * u_factor, corner.uv[1] * v_factor};
  });
}

void move_uvs(const UvPoint& offset, Patch& patch) {
  map_uvs(patch, [&](const PatchCorner& corner) {
    return UvPoint{corner.uv[0] + offset[0], corner.uv[1] + offset[1]};
  });
}

void mirror_uvs(Dice& dice, Patch& patch) {
  const double across = dice.pick<double>({0, 0.5, 1});
  map_uvs(patch, [&](const PatchCorner& corner) {
    return UvPoint{across - corner.uv[0], corner.uv[1]};
  });
}

// Onto texel borders and centres, onto the units that a raster snaps to, or between those.
void put_on_lattice(Dice& dice, uint32_t side, Patch& patch) {
  const double steps = dice.pick<double>({1, 2, 256, 512}) * side;
  map_uvs(patch, [&](const PatchCorner& corner) {
    return UvPoint{std::round(corner.uv[0] * steps) / steps,
                   std::round(corner.uv[1] * steps) / steps};
  });
}

void shrink_uvs(Dice& dice, Patch& patch) {
  const double factor = dice.pick<double>({0x1p-12, 0x1p-8, 0x1p-5, 0x1p-3});
  scale_uvs(factor, factor * dice.pick<double>({1, 1, 0.125, 8}), patch);
}

UvPoint middle_of(const Patch& patch) {
  UvPoint low = patch.faces[0][0].uv, high = low;
  for (const PatchFace& face : patch.faces) {
    for (const PatchCorner& corner : face) {
      for (size_t i = 0; i < 2; ++i) {
        low[i] = std::min(low[i], corner.uv[i]);
        high[i] = std::max(high[i], corner.uv[i]);
      }
    }
  }
  return {(low[0] + high[0]) / 2, (low[1] + high[1]) / 2};
}

// To far larger than the texture, about its middle: else the whole texture would be shifted until
// all the rest lies beside it.
void enlarge_uvs(Dice& dice, Patch& patch) {
  const UvPoint middle = middle_of(patch);
  const double factor = dice.pick<double>({4, 16, 100, 3000});
  move_uvs({-middle[0], -middle[1]}, patch);
  scale_uvs(factor, factor * dice.pick<double>({1, 1, 0.125, 8}), patch);
  move_uvs({0.5, 0.5}, patch);
}

// Folded along a line, so that halves may cancel each other.
void close_uvs(Patch& patch) {
  map_uvs(patch, [](const PatchCorner& corner) {
    return UvPoint{std::abs(corner.uv[0] - 0.25), corner.uv[1]};
  });
}

bool pinch_face(PatchFace& face, size_t kept, size_t moved) {
  const auto corner_at = [&](size_t vertex) {
    return std::find_if(face.begin(), face.end(),
                        [&](const PatchCorner& corner) { return corner.vertex == vertex; });
  };
  const auto from = corner_at(kept), to = corner_at(moved);
  if (from == face.end() || to == face.end()) return false;
  to->uv = from->uv;
  return true;
}

// An edge becomes a point of the texture, on one side or on both, and then another one.
void pinch_an_edge(Dice& dice, Patch& patch) {
  const PatchFace& face = patch.faces[dice.below(patch.faces.size())];
  const size_t k = dice.below(face.size());
  size_t kept = face[k].vertex, moved = face[(k + 1) % face.size()].vertex;
  const bool both = dice.chance(0.5);
  for (PatchFace& other : patch.faces) {
    if (!pinch_face(other, kept, moved)) continue;
    if (!both) return;
    std::swap(kept, moved);
  }
}

struct ChartStyle {
  bool large;  // some charts are far larger than the texture
  bool wild;   // charts lie anywhere
  uint32_t texture_side;
};

void change_chart(Dice& dice, const ChartStyle& style, Patch& patch) {
  if (dice.chance(0.2)) shrink_uvs(dice, patch);
  if (dice.chance(0.8)) move_uvs(any_offset(dice, 0, 8, 16), patch);
  if (dice.chance(0.15)) scatter_uvs(dice, patch);
  if (dice.chance(0.15)) tear_uvs(dice, patch);
  if (dice.chance(0.1)) close_uvs(patch);
  if (dice.chance(0.2)) mirror_uvs(dice, patch);
  if (dice.chance(0.2)) scale_uvs(dice.pick<double>({0.25, 0.5, 2, 3}), 1, patch);
  if (dice.chance(0.1)) scale_uvs(1, 0, patch);
  if (dice.chance(0.05)) scale_uvs(0, 0, patch);
  if (style.large && dice.chance(0.3)) enlarge_uvs(dice, patch);
  if (style.wild && dice.chance(0.3)) move_uvs(any_offset(dice, -3, 3, 1), patch);
  if (style.wild && dice.chance(0.1)) scale_uvs(dice.pick<double>({0x1p20, 0x1p33}), 1, patch);
  if (dice.chance(0.5)) put_on_lattice(dice, style.texture_side, patch);
  if (dice.chance(0.3)) pinch_an_edge(dice, patch);
}

// ---- From patches to a draft ----

struct Style {
  bool calm;  // manifold but for coincident vertices, without defects
  Point scale;
  bool lattice;
  double reuse;  // chance that a vertex at a place that is taken is shared
  double split;  // chance that a corner gets a vertex of its own at the same place
  double unmapped;
  size_t materials;
  double stray;  // chance that a polygon has another material than its patch
};

// Powers of two keep the lattice exact. The other scale has a ratio that keeps distortions from
// being 100, where qcd is cut, but for rounding.
Point any_scale(Dice& dice) {
  const auto uniform = [](double x) { return Point{x, x, x}; };
  return dice.pick<Point>({uniform(1), uniform(1), uniform(1), uniform(0x1p-20), uniform(0x1p20),
                           Point{0.1, 0.097, 0.1}});
}

Style make_style(Dice& dice, bool calm, double defect_chance) {
  const auto maybe = [&](double value) { return dice.chance(defect_chance) ? value : 0; };
  Style style{};
  style.calm = calm;
  style.scale = any_scale(dice);
  style.lattice = dice.chance(0.75);
  style.reuse = calm ? 0 : dice.pick<double>({0, 0, 0.5, 1});
  style.split = maybe(dice.pick<double>({0.1, 0.5, 1}));
  style.unmapped = maybe(0.3);
  style.materials = 1 + dice.below(4);
  style.stray = dice.pick<double>({0.05, 0.05, 0.5, 0.5});
  return style;
}

size_t place_vertex(Dice& dice, const Style& style, const Point& position, Draft& draft) {
  const auto taken = std::find(draft.positions.begin(), draft.positions.end(), position);
  if (taken != draft.positions.end() && dice.chance(style.reuse)) {
    return static_cast<size_t>(taken - draft.positions.begin());
  }
  draft.positions.push_back(position);
  return draft.positions.size() - 1;
}

std::vector<size_t> place_vertices(Dice& dice, const Style& style, const Patch& patch,
                                   Draft& draft) {
  const Point offset = {dice.between(-1, 2) / 1.0, dice.between(-1, 2) / 1.0,
                        dice.between(0, 1) / 1.0};
  std::vector<size_t> placed;
  for (const Point& point : patch.points) {
    Point position;
    for (size_t i = 0; i < 3; ++i) {
      const double jitter = style.lattice ? 0 : 0.25 * dice.unit();
      position[i] = (point[i] + offset[i] + jitter) * style.scale[i];
    }
    placed.push_back(place_vertex(dice, style, position, draft));
  }
  return placed;
}

size_t place_uv(Dice& dice, const UvPoint& uv, Draft& draft) {
  const auto taken = std::find(draft.uvs.begin(), draft.uvs.end(), uv);
  if (taken != draft.uvs.end() && dice.chance(0.8)) {
    return static_cast<size_t>(taken - draft.uvs.begin());
  }
  draft.uvs.push_back(uv);
  return draft.uvs.size() - 1;
}

void add_patch(Dice& dice, const Style& style, const Patch& patch, Draft& draft) {
  const std::vector<size_t> placed = place_vertices(dice, style, patch, draft);
  const UvIndex uv_index = dice.chance(style.unmapped) ? UvIndex::kNone : UvIndex::kGood;
  const size_t material = dice.below(style.materials);
  for (const PatchFace& face : patch.faces) {
    Polygon polygon{{}, dice.chance(style.stray) ? dice.below(style.materials) : material};
    for (const PatchCorner& corner : face) {
      size_t vertex = placed[corner.vertex];
      if (dice.chance(style.split)) {
        draft.positions.push_back(Point(draft.positions[vertex]));
        vertex = draft.positions.size() - 1;
      }
      polygon.corners.push_back({vertex, place_uv(dice, corner.uv, draft), uv_index});
    }
    draft.polygons.push_back(polygon);
  }
}

void jitter_uvs(Dice& dice, Patch& patch) {
  map_uvs(patch, [&](const PatchCorner& corner) {
    return UvPoint{corner.uv[0] + 0.02 * dice.unit(), corner.uv[1] + 0.02 * dice.unit()};
  });
}

Draft make_draft(Dice& dice, bool calm, uint32_t texture_side, const RandomMeshOptions& options) {
  const Style style = make_style(dice, calm, options.defect_chance);
  const ChartStyle charts{dice.chance(0.3), dice.chance(options.defect_chance), texture_side};
  const auto target = static_cast<size_t>(dice.between(options.min_faces, options.max_faces));
  Draft draft;
  while (triangle_count(draft) < target) {
    Patch patch = make_patch(dice, style.calm);
    change_chart(dice, charts, patch);
    if (!style.lattice && dice.chance(0.3)) jitter_uvs(dice, patch);
    add_patch(dice, style, patch, draft);
  }
  while (triangle_count(draft) > static_cast<size_t>(options.max_faces)) draft.polygons.pop_back();
  return draft;
}

// ---- Defects ----

Polygon& any_polygon(Dice& dice, Draft& draft) {
  return draft.polygons[dice.below(draft.polygons.size())];
}

Corner& any_corner(Dice& dice, Draft& draft) {
  Polygon& polygon = any_polygon(dice, draft);
  return polygon.corners[dice.below(polygon.corners.size())];
}

void flip_a_face(Dice& dice, Draft& draft) {
  Polygon& polygon = any_polygon(dice, draft);
  std::reverse(polygon.corners.begin(), polygon.corners.end());
}

void repeat_a_face(Dice& dice, Draft& draft) {
  Polygon polygon = any_polygon(dice, draft);
  if (dice.chance(0.5)) std::reverse(polygon.corners.begin(), polygon.corners.end());
  if (dice.chance(0.5))
    std::rotate(polygon.corners.begin(), polygon.corners.begin() + 1, polygon.corners.end());
  draft.polygons.push_back(polygon);
}

void repeat_an_index(Dice& dice, Draft& draft) {
  Polygon& polygon = any_polygon(dice, draft);
  polygon.corners[0].vertex = polygon.corners[1 + dice.below(2)].vertex;
}

void make_corners_coincide(Dice& dice, Draft& draft) {
  Polygon& polygon = any_polygon(dice, draft);
  draft.positions.push_back(Point(draft.positions[polygon.corners[1].vertex]));
  polygon.corners[0].vertex = draft.positions.size() - 1;
}

// On the line through two vertices, half way or beyond.
void flatten_a_face(Dice& dice, Draft& draft) {
  Polygon& polygon = any_polygon(dice, draft);
  const Point p = draft.positions[polygon.corners[0].vertex];
  const Point q = draft.positions[polygon.corners[1].vertex];
  const double t = dice.pick<double>({0.5, 2, -1});
  draft.positions.push_back(
      {p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1]), p[2] + t * (q[2] - p[2])});
  polygon.corners[2].vertex = draft.positions.size() - 1;
}

void rewire_a_corner(Dice& dice, Draft& draft) {
  any_corner(dice, draft).vertex = dice.below(draft.positions.size());
}

void lose_a_uv(Dice& dice, Draft& draft) {
  const UvIndex index =
      dice.pick<UvIndex>({UvIndex::kNone, UvIndex::kZero, UvIndex::kTooLarge, UvIndex::kTooSmall});
  if (dice.chance(0.5)) {
    any_corner(dice, draft).uv_index = index;
  } else {
    for (Corner& corner : any_polygon(dice, draft).corners) corner.uv_index = index;
  }
}

void move_a_uv(Dice& dice, Draft& draft) {
  draft.uvs[dice.below(draft.uvs.size())] = lattice_uv(dice);
}

void rewire_a_uv(Dice& dice, Draft& draft) {
  any_corner(dice, draft).uv = dice.below(draft.uvs.size());
}

void send_a_uv_far(Dice& dice, Draft& draft) {
  draft.uvs[dice.below(draft.uvs.size())][dice.below(2)] =
      dice.pick<double>({7, -7, 1000, 0x1p27, 0x1p30, 0x1p30 * 1.5, 1e12, -1e12});
}

double any_non_finite(Dice& dice) {
  return dice.pick<double>({kNan, kInfinity, -kInfinity});
}

void spoil_a_position(Dice& dice, Draft& draft) {
  draft.positions[dice.below(draft.positions.size())][dice.below(3)] = any_non_finite(dice);
}

void spoil_a_uv(Dice& dice, Draft& draft) {
  draft.uvs[dice.below(draft.uvs.size())][dice.below(2)] = any_non_finite(dice);
}

void negate_zeros(Dice& dice, Draft& draft) {
  for (int i = 0; i < 10; ++i) {
    double& x = draft.positions[dice.below(draft.positions.size())][dice.below(3)];
    double& u = draft.uvs[dice.below(draft.uvs.size())][dice.below(2)];
    if (x == 0) x = -x;
    if (u == 0) u = -u;
  }
}

void leave_a_vertex_unused(Dice& dice, Draft& draft) {
  Point position = draft.positions[dice.below(draft.positions.size())];
  if (dice.chance(0.5)) position[dice.below(3)] += 0.5;
  if (dice.chance(0.2)) position[dice.below(3)] = any_non_finite(dice);
  draft.positions.push_back(position);
}

void change_a_material(Dice& dice, Draft& draft) {
  any_polygon(dice, draft).material = any_polygon(dice, draft).material;
}

void add_defects(Dice& dice, double chance, Draft& draft) {
  using Defect = void (*)(Dice&, Draft&);
  for (const Defect defect :
       {flip_a_face, repeat_a_face, repeat_an_index, make_corners_coincide, flatten_a_face,
        rewire_a_corner, lose_a_uv, move_a_uv, rewire_a_uv, send_a_uv_far, spoil_a_position,
        spoil_a_uv, negate_zeros, leave_a_vertex_unused, change_a_material}) {
    if (!dice.chance(chance)) continue;
    const size_t times = 1 + dice.below(3);
    for (size_t i = 0; i < times; ++i) defect(dice, draft);
  }
}

// ---- How far the UVs reach ----

// An edge that is longer has more samples along it than can be tried in a test.
constexpr double kFewPeriods = 64;
// Only single UVs are beyond, so that no edge lies there within the reach of a raster.
constexpr double kBeyondReach = 0x1p38;

bool is_within_long_reach(double x) {
  return std::abs(x) > kFewPeriods && std::abs(x) < kBeyondReach;
}

bool reaches_long(const Draft& draft) {
  return std::any_of(draft.uvs.begin(), draft.uvs.end(), [](const UvPoint& uv) {
    return std::any_of(uv.begin(), uv.end(), is_within_long_reach);
  });
}

void fold_long_uvs(Draft& draft) {
  for (UvPoint& uv : draft.uvs) {
    for (double& x : uv) {
      if (is_within_long_reach(x)) x = std::fmod(x, kFewPeriods);
    }
  }
}

// ---- Materials ----

struct MaterialText {
  std::vector<std::string> names;  // by material of the draft; one may be defined nowhere
  std::string mtl;
};

std::string spelled_image(Dice& dice, const std::string& name) {
  const std::string options =
      dice.pick<std::string>({"", "", "", "-s 1 1 1 ", "-o 0.5 0 -bm 1 ", "-clamp on "});
  return options + dice.pick<std::string>({"", "", "./", ".\\"}) + name;
}

std::string material_statement(Dice& dice, const std::string& name,
                               const std::vector<std::string>& images) {
  std::string text = "newmtl " + name + "\nKd 0.8 0.8 0.8\n";
  if (images.empty() || dice.chance(0.15)) return text;
  if (dice.chance(0.1)) text += "map_Kd " + spelled_image(dice, dice.pick(images)) + "\n";
  return text + "  map_Kd " + spelled_image(dice, dice.pick(images)) + "\n";
}

MaterialText make_materials(Dice& dice, const std::vector<std::string>& images) {
  MaterialText text;
  for (const std::string name : {"first", "second one", "third", "fourth"}) {
    text.names.push_back(name);
    if (dice.chance(0.9)) text.mtl += material_statement(dice, name, images);
    if (dice.chance(0.1)) text.mtl += material_statement(dice, name, images);
  }
  return text;
}

std::string library_line(Dice& dice, const std::string& mtl_name) {
  std::string line = "mtllib " + mtl_name;
  if (dice.chance(0.85)) return line;
  return dice.pick<std::string>({"mtllib none.mtl " + mtl_name, "mtllib none.mtl", "# no mtllib"});
}

// ---- Text ----

std::string number_text(Dice& dice, double value) {
  if (std::isnan(value))
    return dice.pick<std::string>({"nan", "-nan", "NaN", "1.#QNAN", "-1.#IND"});
  if (std::isinf(value)) {
    const std::string sign = value < 0 ? "-" : dice.pick<std::string>({"", "+"});
    return sign + dice.pick<std::string>({"inf", "Inf", "1.#INF"});
  }
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.17g", value);
  return text.data();
}

// Sometimes with digits that a float cannot hold.
std::string uv_number_text(Dice& dice, double value) {
  if (dice.chance(0.05)) value *= 1 + 1e-12;
  return number_text(dice, value);
}

std::string vertex_line(Dice& dice, const Point& p) {
  std::string line = "v";
  for (const double x : p) line += " " + number_text(dice, x);
  if (dice.chance(0.02)) line += " 0.5";
  if (dice.chance(0.02)) line += " 0.1 0.2 0.3";
  return line;
}

std::string uv_line(Dice& dice, const UvPoint& uv) {
  std::string line = "vt " + uv_number_text(dice, uv[0]);
  if (uv[1] != 0 || dice.chance(0.5)) line += " " + uv_number_text(dice, uv[1]);
  if (uv[1] != 0 && dice.chance(0.02)) line += " 0";
  return line;
}

// Writes the statements in random order, as far as that keeps the numbering, so that indices point
// back and forth.
class Writer {
 public:
  Writer(Dice& dice, const Draft& draft, const MaterialText& materials, double defect_chance)
      : dice_(dice), draft_(draft), materials_(materials) {
    negative_share_ = dice.pick<double>({0, 0, 0.5, 1});
    invalid_share_ = dice.chance(defect_chance) ? 0.05 : 0;
    noise_share_ = dice.chance(0.3) ? 0.05 : 0;
    end_of_line_ = dice.chance(0.15) ? "\r\n" : "\n";
  }

  std::string write(const std::string& mtl_line) {
    const double early_faces = dice_.pick<double>({0, 0, 0.3, 0.9});
    const bool library_last = dice_.chance(0.1);
    if (!library_last) line(mtl_line);
    while (faces_ < draft_.polygons.size()) {
      const bool all_read = vertices_ == draft_.positions.size() && uvs_ == draft_.uvs.size();
      if (all_read || dice_.chance(early_faces)) {
        write_face();
      } else {
        write_coordinates();
      }
      write_noise();
    }
    while (vertices_ < draft_.positions.size() || uvs_ < draft_.uvs.size()) write_coordinates();
    if (library_last) line(mtl_line);
    return text_;
  }

 private:
  void line(const std::string& content) { text_ += content + end_of_line_; }

  void write_coordinates() {
    const bool vertex_left = vertices_ < draft_.positions.size();
    if (uvs_ < draft_.uvs.size() && (!vertex_left || dice_.chance(0.5))) {
      line(uv_line(dice_, draft_.uvs[uvs_++]));
    } else if (vertex_left) {
      line(vertex_line(dice_, draft_.positions[vertices_++]));
    }
  }

  std::string index_text(size_t index, size_t read) {
    if (index < read && dice_.chance(negative_share_)) return "-" + std::to_string(read - index);
    return std::to_string(index + 1);
  }

  std::string uv_index_text(const Corner& corner) {
    switch (corner.uv_index) {
      case UvIndex::kNone:
        return dice_.pick<std::string>({"", "/", "//1"});
      case UvIndex::kZero:
        return "/0";
      case UvIndex::kTooLarge:
        return dice_.pick<std::string>({"/99999", "/99999999999999999999/1"});
      case UvIndex::kTooSmall:
        return "/-99999";
      case UvIndex::kGood:
        break;
    }
    const std::string text = "/" + index_text(corner.uv, uvs_);
    return text + dice_.pick<std::string>({"", "", "/1"});
  }

  void write_face() {
    const Polygon& polygon = draft_.polygons[faces_++];
    if (material_ != polygon.material) write_material(polygon.material);
    std::string content = "f";
    for (const Corner& corner : polygon.corners) {
      if (dice_.chance(noise_share_)) content += " \\" + end_of_line_;
      content += " " + index_text(corner.vertex, vertices_);
      content += uv_index_text(corner);
    }
    line(content);
    if (dice_.chance(invalid_share_)) write_invalid_face();
  }

  // The first faces often come before any usemtl.
  void write_material(size_t material) {
    if (!material_ && faces_ < 3 && dice_.chance(0.5)) return;
    material_ = material;
    line("usemtl " + materials_.names[material]);
  }

  void write_invalid_face() {
    line(dice_.pick<std::string>({"f 0 1 2", "f 1 2 99999", "f -99999 1 2", "f 1 2", "f", "f 1",
                                  "f 1 2 3 99999999999999999999", "f 3/1 2/1 0/1 1/1"}));
  }

  void write_noise() {
    if (!dice_.chance(noise_share_)) return;
    line(dice_.pick<std::string>({"# a comment", "", "  \t", "vn 0 0 1", "o thing", "g some group",
                                  "s off", "l 1 2", "usemtl nowhere # defined", "f 1 2 3 # four"}));
    material_.reset();
  }

  Dice& dice_;
  const Draft& draft_;
  const MaterialText& materials_;
  double negative_share_ = 0;
  double invalid_share_ = 0;
  double noise_share_ = 0;
  std::string end_of_line_;
  std::string text_;
  size_t vertices_ = 0;
  size_t uvs_ = 0;
  size_t faces_ = 0;
  std::optional<size_t> material_;
};

}  // namespace

RandomModel random_model(uint64_t seed, const RandomMeshOptions& requested) {
  Dice dice(seed);
  RandomMeshOptions options = requested;
  const bool calm = dice.chance(0.3);
  if (calm) options.defect_chance = 0;
  const Textures textures = make_textures(dice);
  Draft draft = make_draft(dice, calm, textures.common_side, options);
  add_defects(dice, options.defect_chance, draft);
  if (dice.chance(0.4)) dice.shuffle(draft.polygons);
  if (dice.chance(0.5)) fold_long_uvs(draft);
  const MaterialText materials = make_materials(dice, textures.names);
  Writer writer(dice, draft, materials, options.defect_chance);
  return {writer.write(library_line(dice, options.mtl_name)), materials.mtl, textures.images,
          textures.size_option, reaches_long(draft)};
}

std::string random_obj(uint64_t seed, const RandomMeshOptions& options) {
  return random_model(seed, options).obj;
}

}  // namespace atlasgauge::oracle
