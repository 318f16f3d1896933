#include "bench/seam_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cmath>
#include <future>
#include <limits>
#include <numbers>
#include <optional>
#include <string_view>

#include "bench/images.hpp"
#include "bench/permutation.hpp"
#include "bench/text_file.hpp"
#include "io/error.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint32_t kMostTextures = 1000;  ///< the answers hold a number for each pair
constexpr std::uint32_t kLargestSize = 32768;
constexpr std::uint64_t kMostEdges = std::uint64_t{1} << 27;  ///< six texture coordinates each
constexpr std::uint64_t kLongest3d = 8;
constexpr std::uint64_t kColumnStep = 4, kRowStep = 2 * kLongest3d;  ///< of the lattice

void require(bool condition, const std::string& text) {
  if (!condition) throw Error(ErrorKind::kUsage, text);
}

const SeamSceneOptions& checked(const SeamSceneOptions& options) {
  require(options.edges > 0 && options.edges <= kMostEdges,
          fmt::format("{} seam edges: from 1 to {} are possible", options.edges, kMostEdges));
  require(options.textures > 0 && options.textures <= kMostTextures,
          fmt::format("{} textures: from 1 to {} are possible", options.textures, kMostTextures));
  require(options.texture_size_texels <= kLargestSize,
          fmt::format("an image has at most {} texels a side here", kLargestSize));
  require(options.length_texels >= 1 && 2 * options.length_texels <= options.texture_size_texels,
          fmt::format("seams of {} texels: from 1 to half of a texture's {} are possible",
                      options.length_texels, options.texture_size_texels));
  const std::string& format = options.image_format;
  require(format == "jpg" || format == "png" || format == "tif",
          fmt::format("image format '{}': jpg, png or tif are possible", format));
  require(options.content != SceneContent::kConstant || format != "jpg",
          "a JPEG does not keep colours; constant content needs png or tif");
  return options;
}

/// Random numbers that follow from a seed.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(mix(seed)) {}

  std::uint64_t below(std::uint64_t end) { return next() % end; }
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t next() { return state_ = mix(state_); }

  std::uint64_t state_;
};

/// A triangle whose first side has the given length and any direction, and whose height is half of
/// it, somewhere in a texture; clockwise or not.
SceneSide draw_side(const SeamSceneOptions& options, Draws& draws) {
  const double size = options.texture_size_texels;
  const double half = options.length_texels * draws.between(0.25, 0.75);
  const double angle = draws.between(0, 2 * std::numbers::pi);
  const double x = draws.between(half, size - half);
  const double y = draws.between(half, size - half);
  const double ahead_x = half * std::cos(angle), ahead_y = half * std::sin(angle);
  const double side = draws.below(2) == 0 ? 1 : -1;
  const auto uv = [size](double column, double row) {
    return std::array{static_cast<float>(column / size), static_cast<float>(row / size)};
  };
  return {static_cast<std::uint32_t>(draws.below(options.textures)),
          {uv(x - ahead_x, y - ahead_y), uv(x + ahead_x, y + ahead_y),
           uv(x - side * ahead_y, y + side * ahead_x)}};
}

double length_texels(const SceneSide& side, double size) {
  const auto along = [&](std::size_t axis) {
    return size * static_cast<double>(side.uv[1][axis]) -
           size * static_cast<double>(side.uv[0][axis]);
  };
  const double x = along(0), y = along(1);
  return std::sqrt(x * x + y * y);
}

}  // namespace

SeamScene::SeamScene(const SeamSceneOptions& options)
    : options_(checked(options)),
      lattice_columns_(
          static_cast<std::uint64_t>(std::ceil(std::sqrt(static_cast<double>(options.edges))))) {}

SceneEdge SeamScene::edge(std::uint64_t index) const {
  Draws draws(mix(options_.seed) ^ index);
  SceneEdge edge{.column = index % lattice_columns_,
                 .row = index / lattice_columns_,
                 .length_3d = 1 + draws.below(kLongest3d),
                 .own_vertices = index % 2 == 1,
                 .sides = {}};
  for (SceneSide& side : edge.sides) side = draw_side(options_, draws);
  return edge;
}

// Channels are 0 or powers of two: a bilinear lookup c (1 - t) + c t then has no rounding error, so
// that equal colours have the distance 0 and not nearly 0.
std::array<std::uint8_t, 3> SeamScene::colour(std::uint32_t texture) const {
  constexpr std::uint64_t kLevels = 9;
  std::uint64_t number = Permutation(kLevels * kLevels * kLevels,
                                     options_.seed)(texture % (kLevels * kLevels * kLevels));
  std::array<std::uint8_t, 3> colour{};
  for (std::uint8_t& channel : colour) {
    channel = static_cast<std::uint8_t>((1U << (number % kLevels)) >> 1);
    number /= kLevels;
  }
  return colour;
}

std::vector<std::string> SeamScene::texture_names() const {
  std::vector<std::string> names;
  for (std::uint32_t texture = 0; texture < options_.textures; ++texture) {
    names.push_back(fmt::format("{}_{}.{}", options_.name, texture, options_.image_format));
  }
  return names;
}

std::uint64_t SeamScene::sample_pairs() const {
  constexpr double kSlack = 1e-6;
  std::uint64_t pairs = 0;
  for (std::uint64_t i = 0; i < options_.edges; ++i) {
    const auto [a, b] = edge(i).sides;
    const double longer = std::max(length_texels(a, options_.texture_size_texels),
                                   length_texels(b, options_.texture_size_texels));
    pairs += 5 * static_cast<std::uint64_t>(std::ceil(longer - kSlack));
  }
  return pairs;
}

// Answers.

namespace {

/// 3D length of the seam edges between each pair of textures.
class PairLengths {
 public:
  explicit PairLengths(const SeamScene& scene)
      : textures_(scene.options().textures), lengths_(std::size_t{textures_} * textures_) {
    for (std::uint64_t i = 0; i < scene.options().edges; ++i) {
      const SceneEdge edge = scene.edge(i);
      const auto [a, b] = std::minmax(edge.sides[0].texture, edge.sides[1].texture);
      lengths_[std::size_t{a} * textures_ + b] += edge.length_3d;
    }
  }

  /// Calls visit(texture, texture, length) for pairs that have seams.
  template <class Visit>
  void for_each(Visit visit) const {
    for (std::uint32_t a = 0; a < textures_; ++a) {
      for (std::uint32_t b = a; b < textures_; ++b) {
        const std::uint64_t length = lengths_[std::size_t{a} * textures_ + b];
        if (length > 0) visit(a, b, length);
      }
    }
  }

 private:
  std::uint32_t textures_;
  std::vector<std::uint64_t> lengths_;
};

double distance(const std::array<std::uint8_t, 3>& a, const std::array<std::uint8_t, 3>& b) {
  int sum = 0;
  for (std::size_t i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return std::sqrt(sum);
}

struct WeightedMean {
  double sum = 0;
  std::uint64_t weight = 0;

  void add(double value, std::uint64_t value_weight) {
    sum += value * static_cast<double>(value_weight);
    weight += value_weight;
  }
  double value() const { return sum / static_cast<double>(weight); }
};

void add_discrepancies(const SeamScene& scene, nlohmann::json& values) {
  const PairLengths lengths(scene);
  const auto distance_of = [&](std::uint32_t a, std::uint32_t b) {
    return distance(scene.colour(a), scene.colour(b));
  };
  double least = std::numeric_limits<double>::infinity(), most = 0;
  WeightedMean all, squares, deviations;
  std::vector<WeightedMean> by_texture(scene.options().textures);
  lengths.for_each([&](std::uint32_t a, std::uint32_t b, std::uint64_t length) {
    const double d = distance_of(a, b);
    least = std::min(least, d);
    most = std::max(most, d);
    all.add(d, length);
    squares.add(d * d, length);
    by_texture[a].add(d, length);
    if (a != b) by_texture[b].add(d, length);
  });
  lengths.for_each([&](std::uint32_t a, std::uint32_t b, std::uint64_t length) {
    deviations.add(std::pow(distance_of(a, b) - all.value(), 2), length);
  });
  values["seam_discrepancy_min"] = least;
  values["seam_discrepancy_max"] = most;
  values["seam_discrepancy_avg"] = all.value();
  values["seam_discrepancy_rms"] = std::sqrt(squares.value());
  values["seam_discrepancy_var"] = deviations.value();
  values["seam_discrepancy_stddev"] = std::sqrt(deviations.value());
  nlohmann::json& means = values["seam_discrepancy_by_texture"] = nlohmann::json::array();
  for (const WeightedMean& mean : by_texture) {
    means.push_back(mean.weight > 0 ? nlohmann::json(mean.value()) : nlohmann::json());
  }
}

double total_length(const SeamScene& scene) {
  std::uint64_t length = 0;
  for (std::uint64_t i = 0; i < scene.options().edges; ++i) length += scene.edge(i).length_3d;
  return static_cast<double>(length);
}

}  // namespace

// Apart from its seam edge a triangle's edges are its own; its height over the seam edge is 1.
Answers seam_scene_answers(const SeamScene& scene) {
  const std::uint64_t edges = scene.options().edges;
  const std::uint64_t welded = edges / 2;
  const double length = total_length(scene);
  Answers answers;
  answers.values = {{"mesh", scene.options().name + ".obj"},
                    {"fn", scene.faces()},
                    {"vn", scene.vertices()},
                    {"vndup", 2 * welded},
                    {"en", 5 * edges + welded},
                    {"en_b", 4 * edges + 2 * welded},
                    {"connected_components", edges + welded},
                    {"area", length},
                    {"oriented", true},
                    {"num_charts", 2 * edges},
                    {"num_null_charts", 0},
                    {"en_uv", 6 * edges},
                    {"en_uv_b", 6 * edges},
                    {"ntex", scene.options().textures},
                    {"textures", scene.texture_names()},
                    {"faces_unmapped", 0},
                    {"faces_untextured", 0},
                    {"faces_uv_outside", 0},
                    {"seam_edges", edges},
                    {"seam_len", length},
                    {"seam_edges_unsampled", 0}};
  if (scene.options().content == SceneContent::kConstant) add_discrepancies(scene, answers.values);
  answers.exact_keys = {"area", "seam_len", "seam_discrepancy_min"};
  return answers;
}

// Files.

namespace {

template <class Visit>
void for_each_edge(const SeamScene& scene, Visit visit) {
  for (std::uint64_t i = 0; i < scene.options().edges; ++i) visit(scene.edge(i), i);
}

void put_vertex(std::uint64_t x, std::uint64_t y, TextFile& obj) {
  obj.put("v ");
  obj.put(x);
  obj.put(' ');
  obj.put(y);
  obj.put(" 0\n");
}

/// The lower and the upper end of the edge, the left and the right corner, and the ends once more
/// if the right triangle has its own.
void put_vertices(const SceneEdge& edge, TextFile& obj) {
  const std::uint64_t x = 1 + edge.column * kColumnStep, y = edge.row * kRowStep;
  const auto put_ends = [&] {
    put_vertex(x, y, obj);
    put_vertex(x, y + edge.length_3d, obj);
  };
  put_ends();
  put_vertex(x - 1, y, obj);
  put_vertex(x + 1, y, obj);
  if (edge.own_vertices) put_ends();
}

/// Shortest text that reads back as the same float.
void put_float(float number, TextFile& obj) {
  std::array<char, 64> text;
  const auto end =
      std::to_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
  obj.put(std::string_view(text.data(), end.ptr));
}

void put_texcoords(const SceneEdge& edge, TextFile& obj) {
  for (const SceneSide& side : edge.sides) {
    for (const auto& [u, v] : side.uv) {
      obj.put("vt ");
      put_float(u, obj);
      obj.put(' ');
      put_float(v, obj);
      obj.put('\n');
    }
  }
}

/// Indices from 0.
void put_corner(std::uint64_t vertex, std::uint64_t texcoord, TextFile& obj) {
  obj.put(' ');
  obj.put(vertex + 1);
  obj.put('/');
  obj.put(texcoord + 1);
}

/// Both triangles run counterclockwise, so the right one runs down the edge.
void put_faces(const SceneEdge& edge, std::uint64_t vertex, std::uint64_t texcoord,
               std::optional<std::uint32_t>& texture, TextFile& obj) {
  const std::uint64_t right_ends = edge.own_vertices ? vertex + 4 : vertex;
  const auto use = [&](const SceneSide& side) {
    if (texture != side.texture) obj.put(fmt::format("usemtl m{}\n", side.texture));
    texture = side.texture;
  };
  use(edge.sides[0]);
  obj.put('f');
  put_corner(vertex, texcoord, obj);
  put_corner(vertex + 1, texcoord + 1, obj);
  put_corner(vertex + 2, texcoord + 2, obj);
  obj.put('\n');
  use(edge.sides[1]);
  obj.put('f');
  put_corner(right_ends + 1, texcoord + 4, obj);
  put_corner(right_ends, texcoord + 3, obj);
  put_corner(vertex + 3, texcoord + 5, obj);
  obj.put('\n');
}

void write_obj(const SeamScene& scene, const std::string& path) {
  TextFile obj(path);
  obj.put("mtllib " + scene.options().name + ".mtl\n");
  for_each_edge(scene, [&](const SceneEdge& edge, std::uint64_t) { put_vertices(edge, obj); });
  for_each_edge(scene, [&](const SceneEdge& edge, std::uint64_t) { put_texcoords(edge, obj); });
  std::optional<std::uint32_t> texture;
  for_each_edge(scene, [&](const SceneEdge& edge, std::uint64_t index) {
    put_faces(edge, scene.first_vertex(index), 6 * index, texture, obj);
  });
  obj.close();
}

void write_mtl(const SeamScene& scene, const std::string& path) {
  TextFile mtl(path);
  std::size_t texture = 0;
  for (const std::string& name : scene.texture_names()) {
    mtl.put(fmt::format("newmtl m{}\nKd 1 1 1\nmap_Kd {}\n", texture++, name));
  }
  mtl.close();
}

PaintRow paint_of(const SeamScene& scene, std::uint32_t texture) {
  const std::uint64_t size = scene.options().texture_size_texels;
  return scene.options().content == SceneContent::kConstant
             ? one_colour(size, scene.colour(texture))
             : photo(size, mix(scene.options().seed) % 1000 + texture);
}

/// Nearly all of the work, and the images have nothing to do with each other.
void write_images(const SeamScene& scene, const std::string& directory, std::size_t threads) {
  const std::vector<std::string> names = scene.texture_names();
  std::atomic<std::uint32_t> next = 0;
  std::vector<std::future<void>> work;
  for (std::size_t i = 0; i < threads; ++i) {
    work.push_back(std::async(std::launch::async, [&] {
      for (std::uint32_t texture = next++; texture < names.size(); texture = next++) {
        write_image(directory + "/" + names[texture], scene.options().texture_size_texels,
                    paint_of(scene, texture));
      }
    }));
  }
  for (std::future<void>& part : work) part.get();
}

}  // namespace

void write_seam_scene(const SeamScene& scene, const std::string& directory, std::size_t threads) {
  const std::string stem = directory + "/" + scene.options().name;
  write_answers(seam_scene_answers(scene), stem + ".answers.json");
  write_mtl(scene, stem + ".mtl");
  write_images(scene, directory, threads);
  write_obj(scene, stem + ".obj");
}

}  // namespace atlasgauge
