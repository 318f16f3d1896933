#include <cmath>
#include <numbers>

#include "bench/worst/families.hpp"
#include "bench/worst/strip.hpp"

namespace atlasgauge {
namespace {

constexpr auto kStrided = Numbering::Kind::kStrided;
constexpr auto kShuffled = Numbering::Kind::kShuffled;

Strip ring(std::uint64_t faces, Numbering::Kind order) {
  return {.faces = faces, .closed = true, .coherent = false, .order = order};
}

std::uint64_t even(std::uint64_t size) {
  return size & ~std::uint64_t{1};
}

std::uint64_t odd(std::uint64_t size) {
  return size | 1;
}

/// Common to both rings: n edges (j, j + 1), shared, and n edges (j, j + 2) on the boundary.
Shape ring_shape(std::uint64_t faces) {
  Shape shape;
  shape.faces = faces;
  shape.positions = faces;
  shape.edges = 2 * faces;
  shape.boundary_edges = faces;
  shape.components = 1;
  shape.largest_component = faces;
  shape.oriented = false;
  shape.charts = 1;
  shape.uv_edges = shape.edges;
  shape.uv_boundary_edges = faces;
  shape.outside = faces;  // corners 0, 1 and n - 1 of the last face are outside, too
  shape.seam_len = 0;
  shape.longest_side = 3 * (static_cast<double>(faces) - 1);
  return shape;
}

// The sides are 0, 2, …, n - 2 and 1, 3, …, n - 1, both of length 2(n - 2) in UV with the way back.
// The n - 2 short faces have UV area 1, the two long ones (n - 2)/2; these run backwards, so that
// the total is 0: the chart is closed in UV, and the two are the fewer of one sign.
Answers annulus_answers(std::uint64_t size) {
  const std::uint64_t faces = even(size);
  const auto n = static_cast<double>(faces);
  Shape shape = ring_shape(faces);
  shape.boundary_components = 2;
  shape.folds = 2;
  shape.area_uv = 2 * (n - 2);
  shape.boundary_len_uv = 4 * (n - 2);
  shape.area = 12 * *shape.area_uv;  // 3 times as wide, 4 times as high
  shape.boundary_len = 12 * (n - 2);
  return answers_of(shape);
}

// The side 0, 2, …, n - 1, 1, 3, …, n - 2 crosses over twice, from (n - 1, 0) to (1, 1) and from
// (n - 2, 1) to (0, 0). As the faces stand, short ones have UV area -1 for even numbers and +1 for
// odd ones, of which there are (n - 3)/2; the two long ones have -(n - 1)/2. So the total is
// negative, and the positive ones are folds.
Answers moebius_answers(std::uint64_t size) {
  const std::uint64_t faces = odd(size);
  const auto n = static_cast<double>(faces);
  Shape shape = ring_shape(faces);
  shape.boundary_components = 1;
  shape.orientable = false;
  shape.nonorientable_charts = 1;
  shape.folds = (faces - 3) / 2;
  shape.area_uv = (n - 2) + (n - 1);
  shape.boundary_len_uv = 2 * (n - 2) + 2 * std::hypot(n - 2, 1);
  shape.area = 12 * *shape.area_uv;
  shape.boundary_len = 6 * (n - 2) + 2 * std::hypot(3 * (n - 2), 4);
  return answers_of(shape);
}

void write_unmapped(std::uint64_t size, const std::string& stem) {
  const Strip strip{.faces = size};
  ObjFile obj(stem);
  put_strip_vertices(strip, obj);
  for (std::uint64_t i = 0; i < size; ++i) obj.put_face(strip.face(i));
  obj.close();
}

/// Every face has a right triangle of legs 1 of its own, 2048 in a row, at even places.
void write_tiles(std::uint64_t size, const std::string& stem) {
  constexpr std::uint64_t kTilesInRow = 2048;
  const Strip strip{.faces = size};
  ObjFile obj(stem);
  put_strip_vertices(strip, obj);
  for (std::uint64_t i = 0; i < size; ++i) {
    const std::uint64_t u = 2 * (i % kTilesInRow), v = 2 * (i / kTilesInRow);
    obj.put_texcoord(u, v);
    obj.put_texcoord(u + 1, v);
    obj.put_texcoord(u, v + 1);
  }
  for (std::uint64_t i = 0; i < size; ++i) {
    obj.put_face(strip.face(i), {3 * i, 3 * i + 1, 3 * i + 2});
  }
  obj.close();
}

/// All shared edges, of length 5, are seams. Only the first tile is inside the unit square.
Answers tiles_answers(std::uint64_t size) {
  const auto n = static_cast<double>(size);
  Shape shape = open_strip_shape(size);
  shape.charts = size;
  shape.uv_edges = 3 * size;
  shape.uv_boundary_edges = 3 * size;
  shape.seam_edges = size - 1;
  shape.seam_len = 5 * (n - 1);
  shape.outside = size - 1;
  shape.area_uv = n / 2;
  shape.boundary_len_uv = n * (2 + std::numbers::sqrt2);
  shape.uniform.erase("qcd");
  shape.uniform.erase("conformality");
  shape.uniform["texel_density"] = std::sqrt(0.5 / 12);
  return answers_of(shape);
}

}  // namespace

std::vector<WorstCase> strip_cases() {
  const auto strip_answers = [](std::uint64_t size) { return answers_of(open_strip_shape(size)); };
  const auto unmapped_answers = [](std::uint64_t size) {
    return answers_of(unmapped_strip_shape(size));
  };
  return {
      {"spiral", "labels: neighbours are far apart, so no range of faces contracts", "faces",
       [](std::uint64_t size, const std::string& stem) {
         write_strip({.faces = size, .order = kStrided}, stem);
       },
       strip_answers},
      {"annulus", "orientation: it changes at every step, yet must close", "faces",
       [](std::uint64_t size, const std::string& stem) {
         write_strip(ring(even(size), Numbering::Kind::kInOrder), stem);
       },
       annulus_answers},
      {"annulus_shuffled", "orientation through contracted labels", "faces",
       [](std::uint64_t size, const std::string& stem) {
         write_strip(ring(even(size), kShuffled), stem);
       },
       annulus_answers},
      {"moebius", "orientation: it changes at every step, and does not close", "faces",
       [](std::uint64_t size, const std::string& stem) {
         write_strip(ring(odd(size), Numbering::Kind::kInOrder), stem);
       },
       moebius_answers},
      {"moebius_shuffled", "orientation conflicts through contracted labels", "faces",
       [](std::uint64_t size, const std::string& stem) {
         write_strip(ring(odd(size), kShuffled), stem);
       },
       moebius_answers},
      {"no_vt", "one null chart of all faces", "faces", write_unmapped, unmapped_answers},
      {"tiles", "as many charts as faces, nearly all edges seams", "faces", write_tiles,
       tiles_answers},
  };
}

}  // namespace atlasgauge
