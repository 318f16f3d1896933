#pragma once

#include <draco/compression/encode.h>
#include <draco/mesh/mesh.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

namespace atlasgauge {

/// How a mesh is encoded. Speed 10 gives edgebreaker one connectivity for all attributes.
struct DracoEncoding {
  bool edgebreaker = true;
  int speed = 5;
  int position_bits = 0;  ///< 0: as they are
  int uv_bits = 0;
};

inline std::string encode_draco(const draco::Mesh& mesh, const DracoEncoding& encoding) {
  draco::Encoder encoder;
  encoder.SetEncodingMethod(encoding.edgebreaker ? draco::MESH_EDGEBREAKER_ENCODING
                                                 : draco::MESH_SEQUENTIAL_ENCODING);
  encoder.SetSpeedOptions(encoding.speed, encoding.speed);
  if (encoding.position_bits != 0) {
    encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, encoding.position_bits);
  }
  if (encoding.uv_bits != 0) {
    encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, encoding.uv_bits);
  }
  draco::EncoderBuffer buffer;
  const draco::Status status = encoder.EncodeMeshToBuffer(mesh, &buffer);
  if (!status.ok()) throw std::runtime_error(status.error_msg_string());
  return {buffer.data(), buffer.size()};
}

/// Two faces a cell of a bumpy grid of cells x cells.
struct DracoGrid {
  int cells = 2;
  bool has_texcoords = true;
  bool lie_apart = false;      ///< every face has texture coordinates of its own
  bool is_soup = false;        ///< and positions
  int further_attributes = 0;  ///< of three doubles, all different
  bool has_materials = false;  ///< 1 for the second face of a cell, else 0

  std::unique_ptr<draco::Mesh> mesh() const {
    draco::TriangleSoupMeshBuilder builder;
    builder.Start(2 * cells * cells);
    add_attributes(builder);
    for (int face = 0; face < 2 * cells * cells; ++face) add_face(builder, face);
    std::unique_ptr<draco::Mesh> mesh = builder.Finalize();
    if (has_materials) name_materials(*mesh);
    return mesh;
  }

 private:
  using Type = draco::GeometryAttribute;

  void add_attributes(draco::TriangleSoupMeshBuilder& builder) const {
    builder.AddAttribute(Type::POSITION, 3, draco::DT_FLOAT32);
    if (has_texcoords) builder.AddAttribute(Type::TEX_COORD, 2, draco::DT_FLOAT32);
    if (has_materials) builder.AddAttribute(Type::GENERIC, 1, draco::DT_UINT8);
    for (int i = 0; i < further_attributes; ++i) {
      builder.AddAttribute(Type::GENERIC, 3, draco::DT_FLOAT64);
    }
  }

  void add_face(draco::TriangleSoupMeshBuilder& builder, int face) const {
    const int cell = face / 2;
    const int x = cell % cells, y = cell / cells;
    using Point = std::pair<int, int>;
    const std::array<Point, 3> corners = {Point{x, y},
                                          face % 2 == 0 ? Point{x + 1, y} : Point{x + 1, y + 1},
                                          face % 2 == 0 ? Point{x + 1, y + 1} : Point{x, y + 1}};
    std::array<std::array<float, 3>, 3> p{};
    std::array<std::array<float, 2>, 3> t{};
    std::array<std::array<double, 3>, 3> further{};
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [cx, cy] = corners[i];
      p[i] = position(cx, cy, face);
      t[i] = texcoord(cx, cy, face);
      further[i] = {face + 0.1 * static_cast<double>(i), 1, 2};
    }
    const draco::FaceIndex index(static_cast<std::uint32_t>(face));
    int id = 0;
    const auto set = [&](const auto& values) {
      builder.SetAttributeValuesForFace(id++, index, values[0].data(), values[1].data(),
                                        values[2].data());
    };
    set(p);
    if (has_texcoords) set(t);
    if (has_materials) {
      const auto material = static_cast<std::uint8_t>(face % 2);
      builder.SetPerFaceAttributeValueForFace(id++, index, &material);
    }
    for (int i = 0; i < further_attributes; ++i) set(further);
  }

  std::array<float, 3> position(int x, int y, int face) const {
    const auto bump = static_cast<float>(std::sin(x * 12.9898 + y * 78.233));
    return {static_cast<float>(x) + 0.2F * bump, static_cast<float>(y) - 0.3F * bump,
            is_soup ? static_cast<float>(face) : bump};
  }

  std::array<float, 2> texcoord(int x, int y, int face) const {
    const float u = static_cast<float>(x) / static_cast<float>(cells);
    const float v = static_cast<float>(y) / static_cast<float>(cells);
    if (!lie_apart) return {u, v};
    return {static_cast<float>(face % 997) / 997 + u / 1000, static_cast<float>(face) + v};
  }

  void name_materials(draco::Mesh& mesh) const {
    auto metadata = std::make_unique<draco::AttributeMetadata>();
    metadata->AddEntryString("name", "material");
    metadata->AddEntryInt("roof tiles", 1);
    metadata->AddEntryInt("wall", 0);
    mesh.AddAttributeMetadata(has_texcoords ? 2 : 1, std::move(metadata));
  }
};

}  // namespace atlasgauge
