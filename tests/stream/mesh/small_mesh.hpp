#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "io/texture/texture_slots.hpp"
#include "stream/mesh/mesh_store.hpp"
#include "stream/mesh/triangle.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {

using Indices3 = std::array<std::uint32_t, 3>;

/// A mesh written down by hand.
struct SmallMesh {
  std::vector<Position> positions;
  std::vector<TexCoord> texcoords;
  std::vector<FaceRecord> faces;

  std::uint32_t vertex(double x, double y, double z = 0) {
    positions.push_back({x, y, z});
    return static_cast<std::uint32_t>(positions.size() - 1);
  }
  std::uint32_t uv(float u, float v) {
    texcoords.push_back({u, v});
    return static_cast<std::uint32_t>(texcoords.size() - 1);
  }
  void face(Indices3 v, Indices3 t, std::uint32_t material = 0) {
    FaceRecord face{};
    for (std::size_t k = 0; k < 3; ++k) {
      face.v[k] = VertexId{v[k]};
      face.t[k] = TexCoordId{t[k]};
    }
    face.material = MaterialId{material};
    faces.push_back(face);
  }
  /// Every corner's UV has the index of its vertex.
  void face(Indices3 v) { face(v, v); }

  MeshStore store(TestEngine& engine) const {
    MeshStore mesh;
    mesh.positions = spill_of(engine, positions);
    mesh.texcoords = spill_of(engine, texcoords);
    mesh.faces = spill_of(engine, faces);
    for (const Position& p : positions) {
      if (is_finite(p)) mesh.box.add(p);
    }
    for (const TexCoord& t : texcoords) {
      const bool inside = t.u >= 0 && t.u <= 1 && t.v >= 0 && t.v <= 1;
      if (is_finite(t) && !inside) mesh.uvs_in_unit_square = false;
    }
    return mesh;
  }
};

/// No UV at this corner.
inline constexpr std::uint32_t kNoUv = ~0U;
inline constexpr Indices3 kNoUvs{kNoUv, kNoUv, kNoUv};

/// One readable image for all materials, 1x1 unless told: texels are UVs then.
inline TextureSlots one_image(std::uint32_t width = 1, std::uint32_t height = 1) {
  TextureSlots slots;
  slots.slots.push_back({"image.png", {.path = "image.png"}, ImageSize{width, height}, true});
  slots.of_material = {SlotId{0}};
  slots.has_images = true;
  return slots;
}

/// Vertices on a grid, each with its place in the unit square as UV.
inline SmallMesh grid_vertices(std::uint32_t columns, std::uint32_t rows) {
  SmallMesh mesh;
  for (std::uint32_t y = 0; y < rows; ++y) {
    for (std::uint32_t x = 0; x < columns; ++x) {
      mesh.vertex(x, y);
      mesh.uv(static_cast<float>(x) / static_cast<float>(columns),
              static_cast<float>(y) / static_cast<float>(rows));
    }
  }
  return mesh;
}

/// Two faces a cell of such a grid.
inline SmallMesh grid_mesh(std::uint32_t columns, std::uint32_t rows) {
  SmallMesh mesh = grid_vertices(columns, rows);
  for (std::uint32_t y = 0; y + 1 < rows; ++y) {
    for (std::uint32_t x = 0; x + 1 < columns; ++x) {
      const std::uint32_t v = y * columns + x;
      mesh.face({v, v + 1, v + columns});
      mesh.face({v + 1, v + columns + 1, v + columns});
    }
  }
  return mesh;
}

/// A band of `quads` quads, closed into a Moebius strip. Without UVs.
inline SmallMesh moebius_strip(std::uint32_t quads) {
  SmallMesh mesh;
  const std::uint32_t vertices = 2 * quads;
  for (std::uint32_t i = 0; i < vertices; ++i) mesh.vertex(i, i * i % 7, i % 3);
  const auto v = [&](std::uint32_t quad, std::uint32_t side) {
    return quad < quads ? 2 * quad + side : 1 - side;
  };
  for (std::uint32_t i = 0; i < quads; ++i) {
    mesh.face({v(i, 0), v(i + 1, 0), v(i, 1)}, kNoUvs);
    mesh.face({v(i, 1), v(i + 1, 0), v(i + 1, 1)}, kNoUvs);
  }
  return mesh;
}

/// `triangles` around vertex 0, the fan open or closed.
inline SmallMesh fan(std::uint32_t triangles, bool closed) {
  SmallMesh mesh;
  mesh.vertex(0, 0);
  const std::uint32_t rim = triangles + (closed ? 0 : 1);
  for (std::uint32_t i = 0; i < rim; ++i) mesh.vertex(std::cos(i), std::sin(i), i);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    mesh.face({0, 1 + i, 1 + (i + 1) % rim}, kNoUvs);
  }
  return mesh;
}

/// `triangles` that share the edge (0, 1).
inline SmallMesh book(std::uint32_t triangles) {
  SmallMesh mesh;
  mesh.vertex(0, 0);
  mesh.vertex(0, 3);
  for (std::uint32_t i = 0; i < triangles; ++i) {
    mesh.face({0, 1, mesh.vertex(std::cos(i), 1, std::sin(i))}, kNoUvs);
  }
  return mesh;
}

}  // namespace atlasgauge
