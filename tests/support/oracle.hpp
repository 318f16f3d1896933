#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

// A second opinion on every number of the report that needs no raster and no colours, written from
// the specification alone. It shares no code with the program, holds everything in memory and
// prefers the plain way to the fast one.
//
// Values of single faces and edges are doubles by the formulas of the specification, each operation
// rounded for itself: compile with -ffp-contract=off. Sums, statistics and percentiles over them
// are taken exactly and rounded once.
namespace atlasgauge::oracle {

using Size = std::pair<uint32_t, uint32_t>;
using Position = std::array<double, 3>;
using Uv = std::array<float, 2>;
using Texel = std::array<double, 2>;
using Triple = std::array<int64_t, 3>;

struct Options {
  std::optional<Size> size_option;
  // The size of a readable image. The path is normal, with the folder of the MTL or of the OBJ in
  // front; the file itself need not exist.
  std::function<std::optional<Size>(const std::string& path)> image_size;
};

struct Slot {
  std::string name;
  std::string path;
  std::optional<Size> size;
  bool readable = false;
};

struct Face {
  Triple vertices;
  std::array<std::optional<Uv>, 3> uvs;  // only finite ones, as in the file
  std::optional<int64_t> slot;
};

struct Model {
  std::string name;
  std::vector<Position> positions;
  std::vector<Slot> slots;
  std::vector<Face> faces;
  bool with_images = false;
  int64_t invalid_polygons = 0;
};

// Everything that is known of one face once the levels are sorted out.
struct FaceFacts {
  bool degenerate = false;
  bool non_finite = false;
  bool raw = false;     // takes part in the raw level
  bool welded = false;  // takes part in the welded and the uv level
  double area = 0;
  bool has_uv_triangle = false;
  bool uv_far = false;
  std::array<Texel, 3> texels{};
  double signed_uv_area = 0;
  Triple welded_vertices{};
  Triple uv_vertices{};
  int64_t chart = -1;
};

struct EdgeUse {
  int64_t face;
  int corner;    // the edge runs from this corner to the next
  bool forward;  // from the smaller to the larger of its vertices
};

using EdgeKey = std::pair<int64_t, int64_t>;
using EdgeMap = std::map<EdgeKey, std::vector<EdgeUse>>;

struct Analysis {
  Model model;
  std::vector<FaceFacts> faces;
  EdgeMap raw_edges;
  EdgeMap welded_edges;
  EdgeMap uv_edges;
};

// Throws std::runtime_error, naming the line, on a statement whose numbers cannot be read.
Model read_obj(const std::string& obj_path, const Options& options);

Analysis analyse(Model model);

nlohmann::json measure(const Analysis& analysis);

nlohmann::json measure_obj(const std::string& obj_path, const Options& options);

}  // namespace atlasgauge::oracle
