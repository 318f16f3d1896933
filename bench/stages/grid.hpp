#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "bench/permutation.hpp"
#include "io/mesh_batch.hpp"
#include "stream/engine/spill.hpp"
#include "stream/mesh/mesh_store.hpp"
#include "stream/mesh/triangle.hpp"

namespace atlasgauge {

/// A level ground of side x side unit quads, two faces each, column after column, cut into charts
/// of whole columns. Everything is a function of its index.
class Grid {
 public:
  explicit Grid(std::uint64_t about_faces)
      : side_(std::max<std::uint32_t>(
            2, static_cast<std::uint32_t>(std::sqrt(static_cast<double>(about_faces) / 2)))) {}

  std::uint32_t faces() const { return 2 * side_ * side_; }
  std::uint32_t vertices() const { return (side_ + 1) * points(); }
  std::uint32_t texcoords() const { return (side_ + charts()) * points(); }
  std::uint32_t charts() const { return (side_ + kChartColumns - 1) / kChartColumns; }
  std::uint32_t edges() const { return 3 * side_ * side_ + 2 * side_; }
  std::uint32_t boundary_edges() const { return 4 * side_; }
  std::uint32_t seam_edges() const { return (charts() - 1) * side_; }

  Position position(std::uint32_t vertex) const {
    const std::uint32_t x = vertex / points(), y = vertex % points();
    return {static_cast<double>(x), static_cast<double>(y), 0};
  }

  TexCoord texcoord(std::uint32_t index) const { return uv(index / points(), index % points()); }

  FaceRecord face(std::uint32_t index) const {
    const Quad quad = quad_of(index);
    FaceRecord face{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [x, y] = corner(quad, index, k);
      face.v[k] = VertexId{x * points() + y};
      face.t[k] = TexCoordId{(x + quad.chart) * points() + y};
    }
    return face;
  }

  /// On a slot of 1 x 1 texels.
  Triangle triangle(std::uint32_t index) const {
    const Quad quad = quad_of(index);
    Triangle triangle{};
    triangle.face = FaceId{index};
    triangle.kind = FaceKind::kWhole;
    triangle.slot_has_size = triangle.has_uv_triangle = true;
    triangle.area_3d = 0.5;
    triangle.area_uv = 0.5;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto [x, y] = corner(quad, index, k);
      triangle.v[k] = triangle.w[k] = VertexId{x * points() + y};
      triangle.p[k] = {static_cast<double>(x), static_cast<double>(y), 0};
      triangle.t[k] = uv(x + quad.chart, y);
      triangle.texel[k] = {triangle.t[k].u, triangle.t[k].v};
    }
    return triangle;
  }

  /// As readers leave it; `face_at(i)` is the number of the face that is the file's i-th.
  template <class FaceAt>
  MeshStore store(Scratch& scratch, FaceAt face_at) const {
    MeshStore mesh;
    mesh.positions = filled<Position>(scratch, vertices(), [&](auto i) { return position(i); });
    mesh.texcoords = filled<TexCoord>(scratch, texcoords(), [&](auto i) { return texcoord(i); });
    mesh.faces = filled<FaceRecord>(scratch, faces(), [&](auto i) { return face(face_at(i)); });
    mesh.box.add({0, 0, 0});
    mesh.box.add({static_cast<double>(side_), static_cast<double>(side_), 0});
    return mesh;
  }

 private:
  static constexpr std::uint32_t kChartColumns = 32;

  /// Vertices of a column.
  std::uint32_t points() const { return side_ + 1; }

  struct Quad {
    std::uint32_t x, y, chart;
  };
  Quad quad_of(std::uint32_t face) const {
    const std::uint32_t quad = face / 2, x = quad / side_;
    return {x, quad - x * side_, x / kChartColumns};
  }

  struct Corner {
    std::uint32_t x, y;
  };
  /// Anticlockwise: a quad's first face lies below its diagonal, the second above.
  static Corner corner(const Quad& quad, std::uint32_t face, std::size_t k) {
    static constexpr Corner kOffsets[2][3]{{{0, 0}, {1, 0}, {1, 1}}, {{0, 0}, {1, 1}, {0, 1}}};
    const Corner& offset = kOffsets[face % 2][k];
    return {quad.x + offset.x, quad.y + offset.y};
  }

  /// Of a point in the columns of all charts, one beside the other.
  TexCoord uv(std::uint32_t column, std::uint32_t row) const {
    return {(static_cast<float>(column) + 0.5F) * u_step_, static_cast<float>(row) * v_step_};
  }

  template <class T, class Make>
  static Spill<T> filled(Scratch& scratch, std::uint32_t count, Make make) {
    SpillWriter<T> writer(scratch);
    for (std::uint32_t i = 0; i < count; ++i) writer.push(make(i));
    return writer.finish();
  }

  std::uint32_t side_;
  float u_step_ = 1 / static_cast<float>(side_ + charts());
  float v_step_ = 1 / static_cast<float>(side_);
};

/// In which order the parts of a model lie in its file.
enum class Order { kMesh, kRandom };

inline const char* name_of(Order order) {
  return order == Order::kMesh ? "mesh_order" : "random_order";
}

/// The part that is the i-th in this order.
class Ordering {
 public:
  Ordering(Order order, std::uint64_t size) : order_(order), permutation_(size, 1) {}
  std::uint32_t operator()(std::uint32_t i) const {
    return order_ == Order::kMesh ? i : static_cast<std::uint32_t>(permutation_(i));
  }

 private:
  Order order_;
  Permutation permutation_;
};

}  // namespace atlasgauge
