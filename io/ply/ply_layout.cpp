#include "io/ply/ply_layout.hpp"

#include <fmt/format.h>

#include <array>
#include <utility>

#include "io/error.hpp"
#include "io/model/element_room.hpp"

namespace atlasgauge {
namespace {

using Pair = std::pair<std::size_t, std::size_t>;

[[noreturn]] void refuse(const std::string& path, std::uint64_t line, const std::string& text) {
  throw Error(ErrorKind::kInput, path, line, text);
}

/// Places of the first pair of names that is there.
std::optional<Pair> find_uv(const PlyElement& vertex) {
  using Names = std::pair<std::string_view, std::string_view>;
  constexpr std::array kNames = {Names{"s", "t"}, Names{"u", "v"}, Names{"texture_u", "texture_v"}};
  for (const auto& [u_name, v_name] : kNames) {
    const auto u = vertex.find({u_name}, false);
    const auto v = vertex.find({v_name}, false);
    if (u && v) return Pair{*u, *v};
  }
  return std::nullopt;
}

void lay_out_vertices(const PlyElement& vertex, const std::string& path, PlyLayout& layout) {
  check_room(path, "positions", 0, vertex.count);
  layout.vertices = vertex.count;
  layout.vertex_roles.assign(vertex.properties.size(), PlyLayout::kNoRole);
  using Axis = std::pair<std::string_view, PlyLayout::Role>;
  constexpr std::array kAxes = {Axis{"x", PlyLayout::kX}, Axis{"y", PlyLayout::kY},
                                Axis{"z", PlyLayout::kZ}};
  for (const auto& [name, role] : kAxes) {
    const auto place = vertex.find({name}, false);
    if (!place && vertex.count != 0) {
      refuse(path, vertex.line,
             fmt::format("found element vertex without a number {}, expected x, y and z; export "
                         "the model again",
                         name));
    }
    if (place) layout.vertex_roles[*place] = role;
  }
  if (layout.face_texcoord) return;
  const std::optional<Pair> uv = find_uv(vertex);
  if (!uv) return;
  layout.vertices_have_uv = true;
  layout.vertex_roles[uv->first] = PlyLayout::kU;
  layout.vertex_roles[uv->second] = PlyLayout::kV;
}

void lay_out_faces(const PlyElement& face, const std::string& path, PlyLayout& layout) {
  layout.polygons = face.count;
  layout.face_indices = face.find({"vertex_indices", "vertex_index"}, true);
  layout.face_texcoord = face.find({"texcoord"}, true);
  layout.face_texnumber = face.find({"texnumber"}, false);
  if (layout.face_indices || face.count == 0) return;
  refuse(path, face.line,
         "found element face without a list vertex_indices; export the model again");
}

}  // namespace

PlyLayout lay_out_ply(const PlyHeader& header, const std::string& path) {
  PlyLayout layout;
  layout.textures = header.texture_files.size();
  const PlyElement* const strips = header.find("tristrips");
  if (strips != nullptr) {
    layout.strip_indices = strips->find({"vertex_indices", "vertex_index"}, true);
  }
  if (const PlyElement* const face = header.find("face")) lay_out_faces(*face, path, layout);
  if (const PlyElement* const vertex = header.find("vertex")) {
    lay_out_vertices(*vertex, path, layout);
  }
  if (layout.vertices == 0 && layout.polygons == 0) {
    refuse(path, 0, "found a PLY file without vertices and faces; give a model");
  }
  return layout;
}

}  // namespace atlasgauge
