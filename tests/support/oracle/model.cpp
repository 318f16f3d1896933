#include "tests/support/oracle/model.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "tests/support/oracle/materials.hpp"
#include "tests/support/oracle/text.hpp"

namespace atlasgauge::oracle {
namespace {

// Zero-based; -1 names nothing. Upper bounds are checked once the whole file is read.
struct Corner {
  int64_t vertex = -1;
  int64_t uv = -1;
};

struct Polygon {
  std::vector<Corner> corners;
  std::optional<std::string> material;
};

struct ObjContent {
  std::vector<Position> positions;
  std::vector<Uv> uvs;
  std::vector<Polygon> polygons;
};

int64_t resolve_index(std::optional<int64_t> index, size_t read_so_far) {
  if (!index || *index == 0) return -1;
  if (*index > 0) return *index - 1;
  return std::max<int64_t>(-1, static_cast<int64_t>(read_so_far) + *index);
}

Corner parse_corner(const Statement& statement, const std::string& word, const ObjContent& obj) {
  const size_t slash = word.find('/');
  Corner corner;
  corner.vertex =
      resolve_index(parse_index(statement, word.substr(0, slash)), obj.positions.size());
  if (slash == std::string::npos) return corner;
  const size_t second = word.find('/', slash + 1);
  const size_t length = second == std::string::npos ? second : second - slash - 1;
  const std::string uv = word.substr(slash + 1, length);
  if (!uv.empty()) corner.uv = resolve_index(parse_index(statement, uv), obj.uvs.size());
  return corner;
}

Position parse_position(const Statement& statement) {
  const std::vector<std::string> words = words_of(statement.rest);
  if (words.size() < 3) fail(statement, "a vertex needs three coordinates");
  Position position;
  for (size_t i = 0; i < 3; ++i) position[i] = parse_double(statement, words[i]);
  return position;
}

Uv parse_uv(const Statement& statement) {
  const std::vector<std::string> words = words_of(statement.rest);
  if (words.empty()) fail(statement, "a texture coordinate needs u");
  const float u = parse_float(statement, words[0]);
  const float v = words.size() > 1 ? parse_float(statement, words[1]) : 0.0F;
  return {u, v};
}

/// Whether a statement is one by which a file shows itself to be an OBJ model.
bool is_of_obj(const Statement& statement) {
  static const std::set<std::string> keywords = {"v",   "vt",   "f",   "usemtl", "mtllib",
                                                 "p",   "l",    "bsp", "bzp",    "cdc",
                                                 "cdp", "curv", "fo",  "curv2",  "surf"};
  return keywords.contains(statement.keyword);
}

ObjContent parse_obj(const std::vector<Statement>& statements) {
  if (std::none_of(statements.begin(), statements.end(), is_of_obj)) {
    throw std::runtime_error("no OBJ statement");
  }
  ObjContent obj;
  std::optional<std::string> material;
  for (const Statement& statement : statements) {
    if (statement.keyword == "v") {
      obj.positions.push_back(parse_position(statement));
    } else if (statement.keyword == "vt") {
      obj.uvs.push_back(parse_uv(statement));
    } else if (statement.keyword == "usemtl") {
      material = statement.rest;
    } else if (statement.keyword == "f") {
      Polygon polygon{{}, material};
      for (const std::string& word : words_of(statement.rest)) {
        polygon.corners.push_back(parse_corner(statement, word, obj));
      }
      obj.polygons.push_back(polygon);
    }
  }
  return obj;
}

template <class Container>
bool names_one_of(int64_t index, const Container& container) {
  return index >= 0 && index < static_cast<int64_t>(container.size());
}

bool is_valid(const Polygon& polygon, const ObjContent& obj) {
  return polygon.corners.size() >= 3 &&
         std::all_of(polygon.corners.begin(), polygon.corners.end(), [&](const Corner& corner) {
           return names_one_of(corner.vertex, obj.positions);
         });
}

std::optional<Uv> uv_of(const Corner& corner, const ObjContent& obj) {
  if (!names_one_of(corner.uv, obj.uvs)) return std::nullopt;
  const Uv uv = obj.uvs[static_cast<size_t>(corner.uv)];
  if (!std::isfinite(uv[0]) || !std::isfinite(uv[1])) return std::nullopt;
  return uv;
}

void add_fan(const Polygon& polygon, const ObjContent& obj, std::optional<int64_t> slot,
             std::vector<Face>& faces) {
  for (size_t i = 2; i < polygon.corners.size(); ++i) {
    const std::array<Corner, 3> corners = {polygon.corners[0], polygon.corners[i - 1],
                                           polygon.corners[i]};
    Face face;
    face.slot = slot;
    for (size_t k = 0; k < 3; ++k) {
      face.vertices[k] = corners[k].vertex;
      face.uvs[k] = uv_of(corners[k], obj);
    }
    faces.push_back(face);
  }
}

}  // namespace

Model read_obj(const std::string& obj_path, const Options& options) {
  const std::vector<Statement> statements = read_statements(obj_path, Backslash::kContinues);
  const ObjContent obj = parse_obj(statements);
  Model model;
  model.name = std::filesystem::path(obj_path).filename().string();
  model.positions = obj.positions;
  const auto slot_of = make_slots(read_materials(statements, obj_path, options), options, model);
  for (const Polygon& polygon : obj.polygons) {
    if (!is_valid(polygon, obj)) {
      ++model.invalid_polygons;
      continue;
    }
    std::optional<int64_t> slot;
    if (!model.with_images) slot = 0;
    if (polygon.material && slot_of.contains(*polygon.material)) {
      slot = slot_of.at(*polygon.material);
    }
    add_fan(polygon, obj, slot, model.faces);
  }
  return model;
}

}  // namespace atlasgauge::oracle
