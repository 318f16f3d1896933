#include "bench/worst/open_fan.hpp"

#include <cmath>

namespace atlasgauge {

void put_open_fan_vertices(std::uint64_t faces, ObjFile& obj) {
  obj.put_vertex(0, 2);
  for (std::uint64_t i = 0; i <= faces; ++i) obj.put_vertex(i, 0);
}

// n + 1 spokes, of which the first (2 long) and the last are on the boundary, and n rim edges.
Shape open_fan_shape(std::uint64_t faces) {
  const auto n = static_cast<double>(faces);
  Shape shape;
  shape.faces = faces;
  shape.positions = faces + 2;
  shape.edges = shape.uv_edges = 2 * faces + 1;
  shape.boundary_edges = shape.uv_boundary_edges = faces + 2;
  shape.components = shape.boundary_components = 1;
  shape.largest_component = faces;
  shape.charts = shape.null_charts = 1;
  shape.unmapped = faces;
  shape.area = n;
  shape.boundary_len = n + 2 + std::hypot(n, 2);
  shape.area_uv = shape.boundary_len_uv = shape.seam_len = 0;
  shape.longest_side = n;
  return shape;
}

}  // namespace atlasgauge
