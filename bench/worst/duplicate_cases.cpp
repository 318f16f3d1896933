#include <algorithm>

#include "bench/worst/families.hpp"
#include "bench/worst/strip.hpp"

namespace atlasgauge {
namespace {

void write_twice(std::uint64_t size, bool turned, const std::string& stem) {
  const Strip strip{.faces = size / 2};
  ObjFile obj(stem);
  put_strip_vertices(strip, obj);
  put_strip_texcoords(strip, obj);
  put_strip_faces(strip, obj);
  for (std::uint64_t i = 0; i < strip.faces; ++i) {
    std::array<std::uint64_t, 3> v = strip.face(i);
    if (turned) std::swap(v[0], v[1]);
    obj.put_face(v, v);
  }
  obj.close();
}

// An edge on the boundary of the strip now has two faces, a shared one four. So only the two faces
// of a pair are joined by manifold edges, and always the same way: orientable. Run coherently, one
// of a pair has UV area +1 and the other -1: the chart is closed in UV, and half are folds. The
// strip's first and last vertex touch no edge of four faces, but have a single fan.
Answers twice_answers(std::uint64_t size, bool turned) {
  const std::uint64_t pairs = size / 2;
  Shape shape = open_strip_shape(pairs);
  shape.faces = shape.largest_component = shape.outside = 2 * pairs;
  shape.duplicates = pairs;
  shape.boundary_edges = shape.uv_boundary_edges = shape.boundary_components = 0;
  shape.nonmanifold_edges = pairs - 1;
  shape.oriented = turned;
  shape.folds = pairs;
  shape.area = 2 * *shape.area;
  shape.area_uv = 2 * *shape.area_uv;
  shape.boundary_len = shape.boundary_len_uv = 0;
  return answers_of(shape);
}

}  // namespace

std::vector<WorstCase> duplicate_cases() {
  return {
      {"duplicated", "every face twice, the same way round", "faces",
       [](std::uint64_t size, const std::string& stem) { write_twice(size, false, stem); },
       [](std::uint64_t size) { return twice_answers(size, false); }},
      {"duplicated_turned", "every face twice, turned over", "faces",
       [](std::uint64_t size, const std::string& stem) { write_twice(size, true, stem); },
       [](std::uint64_t size) { return twice_answers(size, true); }},
  };
}

}  // namespace atlasgauge
