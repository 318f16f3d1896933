#include "bench/worst/families.hpp"
#include "bench/worst/obj_file.hpp"
#include "bench/worst/open_fan.hpp"
#include "bench/worst/shape.hpp"

namespace atlasgauge {
namespace {

/// Closed fans beside each other. The rim of the one from x on lies at (x + i, 0), its hub at
/// (x, 2), and UVs are as positions.
struct Fans {
  std::uint64_t fans, rim;

  std::uint64_t begin_x(std::uint64_t fan) const { return fan * (rim + 1); }
  std::uint64_t hub(std::uint64_t fan) const { return fan * (rim + 1); }
  std::uint64_t rim_vertex(std::uint64_t fan, std::uint64_t i) const {
    return hub(fan) + 1 + i % rim;
  }
};

constexpr std::uint64_t kSomeFans = 4;

void put_fan_points(const Fans& fans, auto put) {
  for (std::uint64_t fan = 0; fan < fans.fans; ++fan) {
    put(fans.begin_x(fan), 2);
    for (std::uint64_t i = 0; i < fans.rim; ++i) put(fans.begin_x(fan) + i, 0);
  }
}

void write_fans(const Fans& fans, const std::string& stem) {
  ObjFile obj(stem);
  put_fan_points(fans, [&](std::uint64_t x, std::uint64_t y) { obj.put_vertex(x, y); });
  put_fan_points(fans, [&](std::uint64_t x, std::uint64_t y) { obj.put_texcoord(x, y); });
  for (std::uint64_t i = 0; i < fans.rim; ++i) {
    for (std::uint64_t fan = 0; fan < fans.fans; ++fan) {
      const std::array v{fans.hub(fan), fans.rim_vertex(fan, i), fans.rim_vertex(fan, i + 1)};
      obj.put_face(v, v);
    }
  }
  obj.close();
}

// Each is a disk of n spokes and n rim edges. n - 1 faces have area 1; the last goes back along the
// rim, its area is n - 1 and its UV area negative: the chart is closed in UV, with one fold.
Answers fans_answers(const Fans& fans) {
  const std::uint64_t faces = fans.fans * fans.rim;
  const auto size = static_cast<double>(fans.fans * 2 * (fans.rim - 1));
  Shape shape;
  shape.faces = faces;
  shape.positions = fans.fans * (fans.rim + 1);
  shape.edges = 2 * faces;
  shape.boundary_edges = faces;
  shape.components = shape.boundary_components = shape.charts = fans.fans;
  shape.largest_component = fans.rim;
  shape.uv_edges = 2 * faces;
  shape.uv_boundary_edges = faces;
  shape.folds = fans.fans;
  shape.outside = faces;  // the hub's v is 2
  shape.area = shape.area_uv = shape.boundary_len = shape.boundary_len_uv = size;
  shape.seam_len = 0;
  shape.longest_side = static_cast<double>(fans.begin_x(fans.fans - 1) + fans.rim - 1);
  return answers_of(shape);
}

/// One spine from (0, 0) to (0, 2), page i to (i + 1, 0). Pages run either way by turns.
void write_edge(std::uint64_t size, const std::string& stem) {
  ObjFile obj(stem);
  obj.put_vertex(0, 0);
  obj.put_vertex(0, 2);
  for (std::uint64_t i = 0; i < size; ++i) obj.put_vertex(i + 1, 0);
  obj.put_texcoord(0, 0);
  obj.put_texcoord(0, 2);
  for (std::uint64_t i = 0; i < size; ++i) obj.put_texcoord(i + 1, 0);
  for (std::uint64_t i = 0; i < size; ++i) {
    const std::array v{i % 2, 1 - i % 2, i + 2};
    obj.put_face(v, v);
  }
  obj.close();
}

// The spine is in all faces, the 2n other edges in one each. Page i has the area i + 1, in UV
// negative for even i: the total has the sign of the last, against which every other page is.
Answers edge_answers(std::uint64_t size) {
  const auto n = static_cast<double>(size);
  Shape shape;
  shape.faces = size;
  shape.positions = size + 2;
  shape.edges = shape.uv_edges = 2 * size + 1;
  shape.boundary_edges = shape.uv_boundary_edges = 2 * size;
  shape.nonmanifold_edges = 1;
  shape.components = shape.boundary_components = shape.charts = 1;
  shape.largest_component = size;
  shape.folds = size / 2;
  shape.outside = size;
  shape.area = shape.area_uv = n * (n + 1) / 2;
  shape.seam_len = 0;
  shape.longest_side = n;
  return answers_of(shape);
}

/// Triangles from (0, 2) to (2i, 0) and (2i + 1, 0), with nothing but the tip in common.
void write_pinch(std::uint64_t size, const std::string& stem) {
  ObjFile obj(stem);
  obj.put_vertex(0, 2);
  for (std::uint64_t i = 0; i < 2 * size; ++i) obj.put_vertex(i, 0);
  for (std::uint64_t i = 0; i < size; ++i) obj.put_face({0, 2 * i + 1, 2 * i + 2});
  obj.close();
}

/// The tip has n fans; the boundary hangs together there.
Answers pinch_answers(std::uint64_t size) {
  Shape shape;
  shape.faces = size;
  shape.positions = 2 * size + 1;
  shape.edges = shape.boundary_edges = 3 * size;
  shape.uv_edges = shape.uv_boundary_edges = 3 * size;
  shape.nonmanifold_vertices = 1;
  shape.components = shape.charts = shape.null_charts = size;
  shape.largest_component = 1;
  shape.boundary_components = 1;
  shape.unmapped = size;
  shape.area = static_cast<double>(size);
  shape.area_uv = shape.boundary_len_uv = shape.seam_len = 0;
  shape.longest_side = 2 * static_cast<double>(size) - 1;
  return answers_of(shape);
}

void write_open_fan(std::uint64_t size, const std::string& stem) {
  ObjFile obj(stem);
  put_open_fan_vertices(size, obj);
  for (std::uint64_t i = 0; i < size; ++i) obj.put_face({0, i + 1, i + 2});
  obj.close();
}

}  // namespace

std::vector<WorstCase> star_cases() {
  return {
      {"fan", "a vertex of all faces", "faces",
       [](std::uint64_t size, const std::string& stem) {
         write_fans({1, size}, stem);
       },
       [](std::uint64_t size) {
         return fans_answers({1, size});
       }},
      {"fans", "several vertices of very many faces", "faces",
       [](std::uint64_t size, const std::string& stem) {
         write_fans({kSomeFans, size / kSomeFans}, stem);
       },
       [](std::uint64_t size) {
         return fans_answers({kSomeFans, size / kSomeFans});
       }},
      {"open_fan", "a vertex of all faces, on the boundary", "faces", write_open_fan,
       [](std::uint64_t size) { return answers_of(open_fan_shape(size)); }},
      {"edge", "an edge of all faces", "faces", write_edge, edge_answers},
      {"pinch", "a vertex of as many fans as faces", "faces", write_pinch, pinch_answers},
  };
}

}  // namespace atlasgauge
