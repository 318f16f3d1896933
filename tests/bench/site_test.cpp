#include "bench/site.hpp"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "tests/support/oracle/oracle.hpp"

namespace atlasgauge {
namespace {

class TempDir {
 public:
  TempDir() {
    std::string pattern = (std::filesystem::temp_directory_path() / "site_XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~TempDir() { std::filesystem::remove_all(path_); }
  TempDir(const TempDir&) = delete;
  TempDir& operator=(const TempDir&) = delete;

  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

SiteOptions small_site() {
  SiteOptions options;
  options.faces = 600;
  options.texture_size_texels = 128;
  options.image_format = ImageFormat::kNone;
  options.chart_side_min_quads = 2;
  options.chart_side_max_quads = 5;
  return options;
}

std::vector<std::string> lines_of(const SiteOptions& options) {
  const TempDir directory;
  write_site(Site(options), directory.path());
  std::ifstream file(directory.path() + "/" + options.name + ".obj");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  return lines;
}

std::uint64_t count_starting(const std::vector<std::string>& lines, const std::string& start) {
  return static_cast<std::uint64_t>(std::count_if(
      lines.begin(), lines.end(), [&](const auto& line) { return line.starts_with(start); }));
}

/// Face lines with the material in force.
std::multiset<std::string> faces_with_material(const std::vector<std::string>& lines) {
  std::multiset<std::string> faces;
  std::string material;
  for (const std::string& line : lines) {
    if (line.starts_with("usemtl ")) material = line;
    if (line.starts_with("f ")) faces.insert(material + " " + line);
  }
  return faces;
}

// A naive measurement of the text, of the keys that are more than a constant. It knows nothing of
// how a site is built, except that it has no face of zero area and no edge of three faces.

using Point = std::array<double, 3>;
using Texel = std::array<double, 2>;

struct Triangle {
  std::array<std::size_t, 3> v, t;
  int texture;
};

struct Mesh {
  std::vector<Point> positions;
  std::vector<Texel> texels;
  std::vector<Triangle> triangles;
};

Triangle read_triangle(std::istream& line, int texture) {
  Triangle triangle{.v = {}, .t = {}, .texture = texture};
  char slash = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    line >> triangle.v[k] >> slash >> triangle.t[k];
    --triangle.v[k];
    --triangle.t[k];
  }
  return triangle;
}

Mesh read_mesh(const std::vector<std::string>& lines, double texture_size) {
  Mesh mesh;
  int texture = -1;
  for (const std::string& text : lines) {
    std::istringstream line(text);
    std::string word;
    line >> word;
    if (word == "v") {
      Point& p = mesh.positions.emplace_back();
      line >> p[0] >> p[1] >> p[2];
    } else if (word == "vt") {
      float u = 0;
      float v = 0;
      line >> u >> v;
      mesh.texels.push_back({u * texture_size, v * texture_size});
    } else if (word == "usemtl") {
      line.ignore(2);
      line >> texture;
    } else if (word == "f") {
      mesh.triangles.push_back(read_triangle(line, texture));
    }
  }
  return mesh;
}

Point minus(const Point& a, const Point& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot(const Point& a, const Point& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double area_of(const Point& a, const Point& b) {
  return std::sqrt(dot(a, a) * dot(b, b) - dot(a, b) * dot(a, b)) / 2;
}

double signed_area(const Texel& a, const Texel& b, const Texel& c) {
  return ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2;
}

class Sets {
 public:
  explicit Sets(std::size_t size) : parents_(size) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }
  std::size_t find(std::size_t i) {
    while (parents_[i] != i) i = parents_[i] = parents_[parents_[i]];
    return i;
  }
  void join(std::size_t a, std::size_t b) { parents_[find(a)] = find(b); }

 private:
  std::vector<std::size_t> parents_;
};

using Wedge = std::array<double, 6>;  ///< position, texel, texture: what a level tells apart

struct EdgeUses {
  std::vector<std::size_t> faces;
  std::size_t forward = 0;
};

/// Edges between the wedges that `wedge(triangle, corner)` gives.
template <class Corner>
auto edges_of(const Mesh& mesh, Corner wedge) {
  using Key = decltype(wedge(mesh.triangles[0], 0));
  std::map<std::pair<Key, Key>, EdgeUses> edges;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Key a = wedge(mesh.triangles[f], k);
      const Key b = wedge(mesh.triangles[f], (k + 1) % 3);
      EdgeUses& uses = edges[std::minmax(a, b)];
      uses.faces.push_back(f);
      uses.forward += a < b;
    }
  }
  return edges;
}

template <class Edges>
std::vector<std::size_t> face_labels(const Mesh& mesh, const Edges& edges) {
  Sets sets(mesh.triangles.size());
  for (const auto& [key, uses] : edges) {
    for (const std::size_t face : uses.faces) sets.join(face, uses.faces[0]);
  }
  std::vector<std::size_t> labels;
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) labels.push_back(sets.find(f));
  return labels;
}

std::size_t distinct(const std::vector<std::size_t>& labels) {
  return std::set<std::size_t>(labels.begin(), labels.end()).size();
}

std::size_t largest_class(const std::vector<std::size_t>& labels) {
  std::map<std::size_t, std::size_t> sizes;
  std::size_t largest = 0;
  for (const std::size_t label : labels) largest = std::max(largest, ++sizes[label]);
  return largest;
}

auto raw_edges(const Mesh& mesh) {
  return edges_of(mesh, [](const Triangle& t, std::size_t k) { return t.v[k]; });
}

auto uv_edges(const Mesh& mesh) {
  return edges_of(mesh, [&](const Triangle& t, std::size_t k) {
    const Point& p = mesh.positions[t.v[k]];
    const Texel& uv = mesh.texels[t.t[k]];
    return Wedge{p[0], p[1], p[2], uv[0], uv[1], static_cast<double>(t.texture)};
  });
}

double bounding_side(const Mesh& mesh) {
  double side = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto [low, high] =
        std::minmax_element(mesh.positions.begin(), mesh.positions.end(),
                            [=](const Point& a, const Point& b) { return a[axis] < b[axis]; });
    side = std::max(side, (*high)[axis] - (*low)[axis]);
  }
  return side;
}

void measure_vertices(const Mesh& mesh, nlohmann::json& report) {
  std::set<std::size_t> used;
  for (const Triangle& t : mesh.triangles) used.insert(t.v.begin(), t.v.end());
  const std::set<Point> positions(mesh.positions.begin(), mesh.positions.end());
  report["vn"] = mesh.positions.size();
  report["vnunref"] = mesh.positions.size() - used.size();
  report["vndup"] = mesh.positions.size() - positions.size();
  report["euler"] = used.size() + mesh.triangles.size() - report["en"].get<std::size_t>();
}

void measure_raw_edges(const Mesh& mesh, nlohmann::json& report) {
  const auto edges = raw_edges(mesh);
  Sets loops(mesh.positions.size());
  std::set<std::size_t> on_boundary;
  std::size_t boundary = 0;
  std::size_t crowded = 0;
  double length = 0;
  bool oriented = true;
  for (const auto& [key, uses] : edges) {
    crowded += uses.faces.size() > 2;
    if (uses.faces.size() == 2) oriented = oriented && uses.forward == 1;
    if (uses.faces.size() != 1) continue;
    const Point side = minus(mesh.positions[key.first], mesh.positions[key.second]);
    length += std::sqrt(dot(side, side));
    ++boundary;
    loops.join(key.first, key.second);
    on_boundary.insert({key.first, key.second});
  }
  std::vector<std::size_t> loop_labels;
  for (const std::size_t v : on_boundary) loop_labels.push_back(loops.find(v));
  const std::vector<std::size_t> components = face_labels(mesh, edges);
  report.update({{"en", edges.size()},
                 {"en_b", boundary},
                 {"nonmanif_edge", crowded},
                 {"boundary_len", length},
                 {"boundary_len_normalized", length / bounding_side(mesh)},
                 {"boundary_loops", distinct(loop_labels)},
                 {"boundary_components", distinct(loop_labels)},
                 {"connected_components", distinct(components)},
                 {"largest_component_fn", largest_class(components)},
                 {"oriented", oriented}});
}

void measure_uv_edges(const Mesh& mesh, nlohmann::json& report) {
  std::map<std::pair<Point, Point>, std::vector<std::size_t>> uv_uses;
  std::size_t boundary = 0;
  double boundary_length = 0;
  const auto edges = uv_edges(mesh);
  for (const auto& [key, uses] : edges) {
    const auto& [a, b] = key;
    uv_uses[{{a[0], a[1], a[2]}, {b[0], b[1], b[2]}}].push_back(uses.faces.size());
    if (uses.faces.size() > 1) continue;
    ++boundary;
    boundary_length += std::hypot(a[3] - b[3], a[4] - b[4]);
  }
  std::size_t seams = 0;
  double seam_length = 0;
  for (const auto& [key, uses] : uv_uses) {
    if (uses != std::vector<std::size_t>{1, 1}) continue;
    const Point side = minus(key.first, key.second);
    ++seams;
    seam_length += std::sqrt(dot(side, side));
  }
  report.update({{"en_uv", edges.size()},
                 {"en_uv_b", boundary},
                 {"boundary_len_uv", boundary_length},
                 {"num_charts", distinct(face_labels(mesh, edges))},
                 {"seam_edges", seams},
                 {"seam_len", seam_length}});
}

struct FaceShape {
  double area, area_uv;  ///< the latter signed
  double distortion;
  double angle_min;
};

double angle_degrees(const Point& a, const Point& b) {
  return std::acos(dot(a, b) / std::sqrt(dot(a, a) * dot(b, b))) * 180 / std::numbers::pi;
}

/// Singular values of the map from the face's plane, with its first side as axis, to texels.
double distortion_of(const Point& a, const Point& b, const Texel& s, const Texel& t) {
  const double ax = std::sqrt(dot(a, a));
  const double bx = dot(a, b) / ax;
  const double by = 2 * area_of(a, b) / ax;
  const double m00 = s[0] / ax;
  const double m10 = s[1] / ax;
  const double m01 = (t[0] - m00 * bx) / by;
  const double m11 = (t[1] - m10 * bx) / by;
  const double sum = std::hypot(m00 + m11, m10 - m01);
  const double difference = std::hypot(m00 - m11, m10 + m01);
  return (sum + difference) / std::abs(sum - difference);
}

FaceShape shape_of(const Mesh& mesh, const Triangle& triangle) {
  std::array<Point, 3> sides;
  for (std::size_t k = 0; k < 3; ++k) {
    sides[k] = minus(mesh.positions[triangle.v[(k + 1) % 3]], mesh.positions[triangle.v[k]]);
  }
  double angle = 180;
  for (std::size_t k = 0; k < 3; ++k) {
    angle = std::min(angle, 180 - angle_degrees(sides[k], sides[(k + 1) % 3]));
  }
  const Texel& o = mesh.texels[triangle.t[0]];
  const Texel& p = mesh.texels[triangle.t[1]];
  const Texel& q = mesh.texels[triangle.t[2]];
  const Point b = minus(mesh.positions[triangle.v[2]], mesh.positions[triangle.v[0]]);
  const double distortion =
      distortion_of(sides[0], b, {p[0] - o[0], p[1] - o[1]}, {q[0] - o[0], q[1] - o[1]});
  return {area_of(sides[0], b), signed_area(o, p, q), distortion, angle};
}

std::vector<FaceShape> shapes_of(const Mesh& mesh) {
  std::vector<FaceShape> shapes;
  for (const Triangle& triangle : mesh.triangles) shapes.push_back(shape_of(mesh, triangle));
  return shapes;
}

/// Statistics of `value(shape)` weighted by area. Values that differ by rounding are told apart, so
/// a percentile is good to rounding only; cumulative weights are exact, being dyadic.
template <class Value>
void measure_statistics(const std::string& name, std::vector<FaceShape> shapes, Value value,
                        nlohmann::json& report) {
  std::sort(shapes.begin(), shapes.end(),
            [=](const auto& a, const auto& b) { return value(a) < value(b); });
  double weight = 0;
  double sum = 0;
  double squares = 0;
  for (const FaceShape& shape : shapes) {
    weight += shape.area;
    sum += shape.area * value(shape);
    squares += shape.area * value(shape) * value(shape);
  }
  for (const int percent : {1, 10, 20, 30, 40, 50, 60, 70, 80, 90, 99}) {
    double below = 0;
    const auto at = std::find_if(shapes.begin(), shapes.end(), [&](const FaceShape& shape) {
      below += shape.area;
      return below * 100 >= weight * percent;
    });
    report[name + "_perc" + std::to_string(percent)] = value(*at);
  }
  const double average = sum / weight;
  report[name + "_min"] = value(shapes.front());
  report[name + "_max"] = value(shapes.back());
  report[name + "_avg"] = average;
  report[name + "_rms"] = std::sqrt(squares / weight);
  report[name + "_var"] = squares / weight - average * average;
}

void measure_shapes(const Mesh& mesh, nlohmann::json& report) {
  const std::vector<FaceShape> shapes = shapes_of(mesh);
  double area = 0;
  double area_uv = 0;
  for (const FaceShape& shape : shapes) {
    area += shape.area;
    area_uv += std::abs(shape.area_uv);
  }
  const auto density = [](const FaceShape& s) { return std::abs(s.area_uv) / s.area; };
  measure_statistics(
      "qcd", shapes, [](const FaceShape& s) { return s.distortion; }, report);
  measure_statistics(
      "conformality", shapes, [](const FaceShape& s) { return 1 / s.distortion; }, report);
  measure_statistics(
      "sf", shapes, [=](const FaceShape& s) { return density(s) / (area_uv / area); }, report);
  measure_statistics(
      "texel_density", shapes, [=](const FaceShape& s) { return std::sqrt(density(s)); }, report);
  measure_statistics(
      "angle_min", shapes, [](const FaceShape& s) { return s.angle_min; }, report);
  report["area"] = area;
  report["area_normalized"] = area / std::pow(bounding_side(mesh), 2);
  report["area_uv"] = area_uv;
}

void measure_folds(const Mesh& mesh, nlohmann::json& report) {
  const std::vector<FaceShape> shapes = shapes_of(mesh);
  const std::vector<std::size_t> charts = face_labels(mesh, uv_edges(mesh));
  std::map<std::size_t, double> totals;
  for (std::size_t f = 0; f < charts.size(); ++f) totals[charts[f]] += shapes[f].area_uv;
  std::size_t folds = 0;
  for (std::size_t f = 0; f < charts.size(); ++f) {
    folds += (shapes[f].area_uv < 0) != (totals[charts[f]] < 0);
  }
  report["nfolds"] = folds;
}

/// Whether a point on the left of a→b, or on it, belongs to the triangle: left sides run down,
/// lower sides run right.
bool on_side(const Texel& a, const Texel& b, const Texel& p) {
  const double distance = signed_area(a, b, p);
  return distance > 0 || (distance == 0 && (b[1] < a[1] || (b[1] == a[1] && b[0] > a[0])));
}

void measure_occupancy(const Mesh& mesh, int size, int textures, nlohmann::json& report) {
  std::map<std::array<int, 3>, int> covered;
  for (const Triangle& triangle : mesh.triangles) {
    std::array<Texel, 3> t{mesh.texels[triangle.t[0]], mesh.texels[triangle.t[1]],
                           mesh.texels[triangle.t[2]]};
    if (signed_area(t[0], t[1], t[2]) < 0) std::swap(t[1], t[2]);
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const Texel centre{x + 0.5, y + 0.5};
        const bool inside = on_side(t[0], t[1], centre) && on_side(t[1], t[2], centre) &&
                            on_side(t[2], t[0], centre);
        if (inside) ++covered[{triangle.texture, x, y}];
      }
    }
  }
  report["occupancy"] = static_cast<double>(covered.size()) / (1.0 * size * size * textures);
  report["overlap_within_chart_texels"] = std::count_if(
      covered.begin(), covered.end(), [](const auto& texel) { return texel.second > 1; });
}

nlohmann::json measured(const SiteOptions& options) {
  const auto size = static_cast<int>(options.texture_size_texels);
  const Mesh mesh = read_mesh(lines_of(options), size);
  nlohmann::json report{{"fn", mesh.triangles.size()}};
  measure_raw_edges(mesh, report);
  measure_vertices(mesh, report);
  measure_uv_edges(mesh, report);
  measure_shapes(mesh, report);
  measure_folds(mesh, report);
  measure_occupancy(mesh, size, static_cast<int>(options.textures), report);
  return report;
}

void expect_same(const std::string& key, const nlohmann::json& answer,
                 const nlohmann::json& counted) {
  if (!answer.is_number_float()) {
    EXPECT_EQ(answer, counted) << key;
    return;
  }
  const double want = counted.get<double>();
  EXPECT_NEAR(answer.get<double>(), want, 1e-10 * std::max(1.0, std::abs(want))) << key;
}

struct Variant {
  const char* name;
  SiteOptions options;
};

template <class Change>
Variant variant(const char* name, Change change) {
  Variant variant{name, small_site()};
  change(variant.options);
  return variant;
}

std::vector<Variant> variants() {
  return {
      variant("Plain", [](SiteOptions&) {}),
      variant("SeveralRoofs",
              [](SiteOptions& o) {
                o.faces = 2400;
                o.texture_size_texels = 256;
              }),
      variant("TwoFaces", [](SiteOptions& o) { o.faces = 2; }),
      variant("OneChart", [](SiteOptions& o) { o.chart_side_max_quads = 60; }),
      variant("SmallestCharts",
              [](SiteOptions& o) {
                o.chart_side_min_quads = 1;
                o.chart_side_max_quads = 2;
              }),
      variant("DuplicatedVertices", [](SiteOptions& o) { o.duplicate_vertices = true; }),
      variant("ShuffledFaces", [](SiteOptions& o) { o.shuffle_seed = 5; }),
      variant("ShuffledAndDuplicated",
              [](SiteOptions& o) {
                o.shuffle_seed = 6;
                o.duplicate_vertices = true;
              }),
      variant("ShuffledVertices", [](SiteOptions& o) { o.vertex_shuffle_seed = 7; }),
      variant("ShuffledVerticesOfTheirOwn",
              [](SiteOptions& o) {
                o.vertex_shuffle_seed = 8;
                o.duplicate_vertices = true;
              }),
      variant("ShuffledFacesAndVertices",
              [](SiteOptions& o) {
                o.shuffle_seed = 9;
                o.vertex_shuffle_seed = 10;
              }),
      variant("SixTextures",
              [](SiteOptions& o) {
                o.faces = 900;
                o.textures = 6;
                o.texture_size_texels = 64;
                o.image_format = ImageFormat::kPng;
              }),
      variant("PrimeNumberOfJpegs",
              [](SiteOptions& o) {
                o.faces = 900;
                o.textures = 3;
                o.texture_size_texels = 64;
                o.image_format = ImageFormat::kJpg;
              }),
      variant("TexelsLargerThanQuads",
              [](SiteOptions& o) {
                o.faces = 5000;
                o.texture_size_texels = 64;
                o.chart_side_min_quads = 7;
                o.chart_side_max_quads = 20;
              }),
  };
}

class SiteVariant : public testing::TestWithParam<Variant> {};

TEST_P(SiteVariant, HasTheAnswersThatCountingGives) {
  const SiteOptions& options = GetParam().options;
  const nlohmann::json counted = measured(options);
  const nlohmann::json answers = site_answers(Site(options)).values;
  for (const auto& [key, value] : counted.items()) expect_same(key, answers.at(key), value);
}

/// What the oracle contradicts. The colours of the images do not matter, only that there are some.
std::vector<std::string> oracle_differences(const SiteOptions& options) {
  const oracle::Size size{options.texture_size_texels, options.texture_size_texels};
  const oracle::Pixels black = [](std::int64_t, std::int64_t) { return oracle::Colour{}; };
  const TempDir directory;
  const Site site(options);
  write_site(site, directory.path());
  const nlohmann::json report =
      oracle::measure_obj(directory.path() + "/" + options.name + ".obj",
                          {size, [size](const std::string&) { return size; },
                           [black](const std::string&) { return black; }});
  return differences(report, site_answers(site));
}

TEST_P(SiteVariant, HasTheAnswersThatTheOracleGives) {
  EXPECT_EQ(oracle_differences(GetParam().options), std::vector<std::string>{});
}

TEST_P(SiteVariant, HasAsManyLinesAsItSays) {
  const Site site(GetParam().options);
  const std::vector<std::string> lines = lines_of(site.options());
  const nlohmann::json answers = site_answers(site).values;
  EXPECT_EQ(count_starting(lines, "f "), answers["fn"]);
  EXPECT_EQ(count_starting(lines, "v "), answers["vn"]);
  EXPECT_EQ(count_starting(lines, "vt "), site.texcoords());
  EXPECT_EQ(count_starting(lines, "f "), site.faces());
  EXPECT_EQ(count_starting(lines, "v "), site.vertices());
}

TEST_P(SiteVariant, HasAboutTheFacesAskedFor) {
  const SiteOptions& options = GetParam().options;
  const double wished = static_cast<double>(options.faces);
  EXPECT_NEAR(static_cast<double>(Site(options).faces()), wished, 0.1 * wished);
}

TEST_P(SiteVariant, HasOnlyCoordinatesOnItsLattices) {
  const SiteOptions& options = GetParam().options;
  const double texels = static_cast<double>(options.texture_size_texels);
  const Mesh mesh = read_mesh(lines_of(options), texels);
  for (const Point& p : mesh.positions) {
    for (const double x : p) EXPECT_EQ(x * Site::kLengthUnits, std::round(x * Site::kLengthUnits));
  }
  for (const Texel& t : mesh.texels) {
    for (const double x : t) {
      EXPECT_EQ(x * Site::kTexelUnits, std::round(x * Site::kTexelUnits));
      EXPECT_TRUE(x > 0 && x < texels) << x;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Site, SiteVariant, testing::ValuesIn(variants()),
                         [](const auto& variant) { return std::string(variant.param.name); });

TEST(Site, HasRoofsRampsAndEveryScale) {
  SiteOptions options = small_site();
  options.faces = 2400;
  options.texture_size_texels = 256;
  const nlohmann::json answers = site_answers(Site(options)).values;
  EXPECT_GT(answers["connected_components"], 2);
  EXPECT_GT(answers["vnunref"], 0);
  EXPECT_EQ(answers["qcd_max"], 2.5);
  EXPECT_LT(answers["angle_min_min"], 45);
}

TEST(Site, TexturesHaveEveryKindOfTexel) {
  SiteOptions options = small_site();
  const nlohmann::json levels = site_answers(Site(options)).values["texture_0"];
  ASSERT_EQ(levels.size(), 8U);
  EXPECT_GT(levels[0]["totalTexels_bilinear"], levels[0]["totalTexels"]);
  EXPECT_LT(levels[0]["boundaryTexels"], levels[0]["totalTexels"]);
  EXPECT_EQ(levels[0]["texelClashes"], 0);
  EXPECT_GT(levels[3]["texelClashes"], 0);
}

/// Some corners come within half a snap of a texel centre, some exactly to half a snap.
TEST(Site, SnapsCornersOnEveryLevel) {
  SiteOptions options = small_site();
  options.texture_size_texels = 512;
  options.chart_side_min_quads = 1;
  options.chart_side_max_quads = 2;
  EXPECT_EQ(oracle_differences(options), std::vector<std::string>{});
}

TEST(Site, LargestTextureIsCountedWithoutDrawingIt) {
  SiteOptions options = small_site();
  options.faces = 200'000;
  options.texture_size_texels = 65536;
  options.chart_side_min_quads = 7;
  options.chart_side_max_quads = 60;
  const nlohmann::json answers = site_answers(Site(options)).values;
  const nlohmann::json& levels = answers["texture_0"];
  ASSERT_EQ(levels.size(), 17U);
  EXPECT_EQ(levels[0]["totalTexels"].get<double>(), answers["occupancy"].get<double>() * 0x1p32);
  EXPECT_EQ(levels[16]["rw"], 1);
}

TEST(Site, ShuffledHasTheSameFacesInAnotherOrder) {
  SiteOptions options = small_site();
  options.textures = 2;
  options.image_format = ImageFormat::kPng;
  const std::vector<std::string> ordered = lines_of(options);
  options.shuffle_seed = 1;
  const std::vector<std::string> shuffled = lines_of(options);
  options.shuffle_seed = 2;
  const std::vector<std::string> otherwise = lines_of(options);
  EXPECT_EQ(faces_with_material(shuffled), faces_with_material(ordered));
  EXPECT_NE(shuffled, ordered);
  EXPECT_NE(shuffled, otherwise);
}

TEST(Site, ShuffledVerticesAreTheSameVerticesInAnotherOrder) {
  SiteOptions options = small_site();
  std::vector<std::string> ordered = lines_of(options);
  options.vertex_shuffle_seed = 1;
  std::vector<std::string> shuffled = lines_of(options);
  EXPECT_NE(shuffled, ordered);
  const auto is_vertex = [](const std::string& line) { return line.rfind("v ", 0) == 0; };
  std::erase_if(ordered, std::not_fn(is_vertex));
  std::erase_if(shuffled, std::not_fn(is_vertex));
  EXPECT_NE(shuffled, ordered);
  EXPECT_TRUE(std::is_permutation(shuffled.begin(), shuffled.end(), ordered.begin()));
}

TEST(Site, IsTheSameEveryTime) {
  SiteOptions options = small_site();
  options.shuffle_seed = 1;
  EXPECT_EQ(lines_of(options), lines_of(options));
}

TEST(Site, MoreDecimalsAreZeros) {
  SiteOptions options = small_site();
  const Mesh six = read_mesh(lines_of(options), 1);
  options.decimals = 9;
  const std::vector<std::string> lines = lines_of(options);
  EXPECT_EQ(read_mesh(lines, 1).positions, six.positions);
  EXPECT_TRUE(lines[1].ends_with("000")) << lines[1];
}

TEST(Site, ImagesHaveTheSizeAskedFor) {
  SiteOptions options = small_site();
  options.image_format = ImageFormat::kPng;
  const TempDir directory;
  const Site site(options);
  write_site(site, directory.path());
  for (const std::string& name : site.texture_names()) {
    const auto image = OIIO::ImageInput::open(directory.path() + "/" + name);
    ASSERT_TRUE(image) << name;
    EXPECT_EQ(image->spec().width, 128);
    EXPECT_EQ(image->spec().height, 128);
    EXPECT_EQ(image->spec().nchannels, 3);
  }
}

TEST(Site, RefusesWhatItCannotMake) {
  const auto refuses = [](auto change) {
    SiteOptions options = small_site();
    change(options);
    EXPECT_THROW(Site{options}, Error);
  };
  refuses([](SiteOptions& o) { o.textures = 0; });
  refuses([](SiteOptions& o) { o.textures = 2; });
  refuses([](SiteOptions& o) { o.faces = 1; });
  refuses([](SiteOptions& o) { o.texture_size_texels = 100; });
  refuses([](SiteOptions& o) { o.texture_size_texels = 0; });
  refuses([](SiteOptions& o) { o.chart_side_min_quads = 0; });
  refuses([](SiteOptions& o) { o.chart_side_max_quads = 3; });
  refuses([](SiteOptions& o) { o.decimals = 5; });
  refuses([](SiteOptions& o) { o.texture_size_texels = 131072; });
  refuses([](SiteOptions& o) {
    o.texture_size_texels = 65536;
    o.image_format = ImageFormat::kJpg;
  });
  refuses([](SiteOptions& o) { o.faces = 1'000'000; });
}

TEST(Site, SaysThatItCannotWrite) {
  EXPECT_THROW(write_site(Site(small_site()), "/nowhere/at/all"), Error);
}

class SiteDifferences : public testing::Test {
 protected:
  SiteDifferences() : answers(site_answers(Site(small_site()))), report(answers.values) {}

  /// Scales a real of the report and returns the differences.
  std::vector<std::string> scaled(const std::string& key, double factor) {
    report[key] = report[key].get<double>() * factor;
    return differences(report, answers);
  }

  Answers answers;
  nlohmann::json report;
};

TEST_F(SiteDifferences, NoneBetweenAnswersAndThemselvesReadBack) {
  const auto text = to_json(answers).dump();
  EXPECT_TRUE(differences(report, answers_from_json(nlohmann::json::parse(text))).empty());
}

TEST_F(SiteDifferences, NameAMissingKey) {
  report.erase("seam_edges");
  EXPECT_EQ(differences(report, answers).size(), 1U);
}

TEST_F(SiteDifferences, NameAWrongCount) {
  report["en"] = report["en"].get<int>() + 1;
  EXPECT_EQ(differences(report, answers).size(), 1U);
}

TEST_F(SiteDifferences, NameANull) {
  report["area"] = nullptr;
  EXPECT_EQ(differences(report, answers).size(), 1U);
}

TEST_F(SiteDifferences, OfExactRealsAreTheLastBit) {
  EXPECT_EQ(scaled("area", 1 + 1e-15).size(), 1U);
}

TEST_F(SiteDifferences, OfOtherRealsBeginAtTheTwelfthDigit) {
  EXPECT_TRUE(scaled("crumbliness", 1 + 1e-13).empty());
  EXPECT_EQ(scaled("crumbliness", 1 + 1e-11).size(), 1U);
}

TEST_F(SiteDifferences, OfListsAreThoseOfTheirElements) {
  const auto lines = [this](const nlohmann::json& list) {
    answers.values["list"] = {2.5, nullptr, 7};
    report["list"] = list;
    return differences(report, answers).size();
  };
  EXPECT_EQ(lines({2.5 * (1 + 1e-13), nullptr, 7}), 0U);
  EXPECT_EQ(lines({2.5 * (1 + 1e-11), nullptr, 7}), 1U);
  EXPECT_EQ(lines({2.5, 0.0, 7}), 1U);
  EXPECT_EQ(lines({2.5, nullptr, 8}), 1U);
  EXPECT_EQ(lines({2.5, nullptr}), 1U);
  EXPECT_EQ(lines(2.5), 1U);
}

TEST_F(SiteDifferences, OfAVarianceAreMeasuredByTheMeanSquare) {
  answers.values["sf_var"] = 0.0;
  report["sf_var"] = 1e-15;
  EXPECT_TRUE(differences(report, answers).empty());
}

}  // namespace
}  // namespace atlasgauge
