#include "bench/worst/families.hpp"
#include "bench/worst/strip.hpp"

namespace atlasgauge {
namespace {

void write_degenerate(std::uint64_t size, const std::string& stem) {
  ObjFile obj(stem);
  put_strip_vertices({.faces = size - 2}, obj);
  for (std::uint64_t i = 0; i < size; ++i) obj.put_face({i, (i + 1) % size, i});
  obj.close();
}

Answers degenerate_answers(std::uint64_t size) {
  Shape shape;
  shape.faces = shape.degenerate = size;
  shape.positions = shape.unreferenced = size;
  shape.area = shape.boundary_len = shape.area_uv = shape.boundary_len_uv = shape.seam_len = 0;
  shape.longest_side = 3 * (static_cast<double>(size) - 1);
  return answers_of(shape);
}

void write_one_face(std::uint64_t size, const std::string& stem) {
  ObjFile obj(stem);
  put_strip_vertices({.faces = size - 2}, obj);
  obj.put_face({0, 1, size - 1});
  obj.close();
}

/// The face is (0, 0), (3, 4), (x, y) with x = 3(n - 1) and y = 0 or 4: its area is |3y - 4x| / 2.
Answers one_face_answers(std::uint64_t size) {
  const double x = 3 * (static_cast<double>(size) - 1);
  const double y = size % 2 == 0 ? 4 : 0;
  Shape shape;
  shape.faces = 1;
  shape.positions = size;
  shape.unreferenced = size - 3;
  shape.edges = shape.boundary_edges = shape.uv_edges = shape.uv_boundary_edges = 3;
  shape.components = shape.largest_component = shape.boundary_components = 1;
  shape.charts = shape.null_charts = shape.unmapped = 1;
  shape.area = (4 * x - 3 * y) / 2;
  shape.area_uv = shape.boundary_len_uv = shape.seam_len = 0;
  shape.longest_side = x;
  return answers_of(shape);
}

void write_one_point(std::uint64_t size, const std::string& stem) {
  const Strip strip{.faces = size};
  ObjFile obj(stem);
  for (std::uint64_t i = 0; i < strip.vertices(); ++i) obj.put_vertex(7, 8, 9);
  for (std::uint64_t i = 0; i < size; ++i) obj.put_face(strip.face(i));
  obj.close();
}

/// A strip at the raw level, nothing at the others.
Answers one_point_answers(std::uint64_t size) {
  Shape shape = open_strip_shape(size);
  shape.coincident = shape.positions - 1;
  shape.zero_area = shape.unmapped = size;
  shape.outside = 0;
  shape.charts = shape.uv_edges = shape.uv_boundary_edges = 0;
  shape.area = shape.boundary_len = shape.area_uv = shape.boundary_len_uv = 0;
  shape.longest_side = 0;
  shape.uniform.clear();
  return answers_of(shape);
}

}  // namespace

std::vector<WorstCase> collapse_cases() {
  return {
      {"degenerate", "nothing to group: every face names a vertex twice", "faces", write_degenerate,
       degenerate_answers},
      {"one_face", "tables over vertices that nothing uses", "vertices", write_one_face,
       one_face_answers},
      {"one_point", "weld: all vertices are one, and all faces vanish", "faces", write_one_point,
       one_point_answers},
  };
}

}  // namespace atlasgauge
