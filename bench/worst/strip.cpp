#include "bench/worst/strip.hpp"

#include <cmath>
#include <numbers>

namespace atlasgauge {
namespace {

Numbering vertex_numbering(const Strip& strip) {
  return {strip.order, strip.vertices(), 2};
}

}  // namespace

void put_strip_vertices(const Strip& strip, ObjFile& obj) {
  const Numbering order = vertex_numbering(strip);
  for (std::uint64_t place = 0; place < strip.vertices(); ++place) {
    const std::uint64_t j = order.item_at(place);
    obj.put_vertex(3 * j, 4 * (j % 2));
  }
}

void put_strip_texcoords(const Strip& strip, ObjFile& obj) {
  const Numbering order = vertex_numbering(strip);
  for (std::uint64_t place = 0; place < strip.vertices(); ++place) {
    const std::uint64_t j = order.item_at(place);
    obj.put_texcoord(j, j % 2);
  }
}

void put_strip_faces(const Strip& strip, ObjFile& obj) {
  const Numbering vertex_order = vertex_numbering(strip);
  const Numbering face_order(strip.order, strip.faces, 3);
  for (std::uint64_t place = 0; place < strip.faces; ++place) {
    std::array<std::uint64_t, 3> v = strip.face(face_order.item_at(place));
    for (std::uint64_t& vertex : v) vertex = vertex_order.place_of(vertex);
    obj.put_face(v, v);
  }
}

void write_strip(const Strip& strip, const std::string& stem) {
  ObjFile obj(stem);
  put_strip_vertices(strip, obj);
  put_strip_texcoords(strip, obj);
  put_strip_faces(strip, obj);
  obj.close();
}

// n + 1 edges (j, j + 1), all but the first and the last shared, and n edges (j, j + 2), all on the
// boundary. In UV a face has base 2 and height 1. Every face has a corner with u >= 2.
Shape open_strip_shape(std::uint64_t faces) {
  const auto n = static_cast<double>(faces);
  Shape shape;
  shape.faces = faces;
  shape.positions = faces + 2;
  shape.edges = 2 * faces + 1;
  shape.boundary_edges = faces + 2;
  shape.components = 1;
  shape.largest_component = faces;
  shape.boundary_components = 1;
  shape.charts = 1;
  shape.uv_edges = shape.edges;
  shape.uv_boundary_edges = shape.boundary_edges;
  shape.outside = faces;
  shape.area = 12 * n;
  shape.boundary_len = 6 * n + 10;
  shape.area_uv = n;
  shape.boundary_len_uv = 2 * n + 2 * std::numbers::sqrt2;
  shape.seam_len = 0;
  shape.longest_side = 3 * (n + 1);
  // The map scales by 1/3 along the strip and by 1/4 across.
  shape.uniform = {{"qcd", 4.0 / 3},
                   {"conformality", 3.0 / 4},
                   {"texel_density", std::sqrt(1.0 / 12)},
                   {"angle_min", std::atan2(4, 3) * 180 / std::numbers::pi}};
  return shape;
}

Shape unmapped_strip_shape(std::uint64_t faces) {
  Shape shape = open_strip_shape(faces);
  shape.null_charts = 1;
  shape.unmapped = faces;
  shape.outside = 0;
  shape.area_uv = 0;
  shape.boundary_len_uv = 0;
  shape.uniform = {{"angle_min", shape.uniform.at("angle_min")}};
  return shape;
}

}  // namespace atlasgauge
