#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "bench/worst/families.hpp"
#include "bench/worst/levels.hpp"
#include "bench/worst/obj_file.hpp"
#include "bench/worst/shape.hpp"

namespace atlasgauge {
namespace {

using std::numbers::sqrt2;

using Uv = std::array<double, 2>;
using UvTriangle = std::array<Uv, 3>;

void put_uv(const Uv& uv, ObjFile& obj) {
  obj.put(fmt::format("vt {} {}\n", uv[0], uv[1]));
}

/// Faces of their own vertices, with sides of 3, 4 and 5, one above the other. uv_of(i) is the UV
/// triangle of a face.
template <class UvOf>
void write_loose_faces(std::uint64_t faces, const std::string& stem, UvOf uv_of) {
  ObjFile obj(stem);
  for (std::uint64_t i = 0; i < faces; ++i) {
    obj.put_vertex(0, 0, i);
    obj.put_vertex(3, 0, i);
    obj.put_vertex(0, 4, i);
    for (const Uv& uv : uv_of(i)) put_uv(uv, obj);
    const std::array v{3 * i, 3 * i + 1, 3 * i + 2};
    obj.put_face(v, v);
  }
  obj.close();
}

Shape loose_shape(std::uint64_t faces) {
  const auto n = static_cast<double>(faces);
  Shape shape;
  shape.faces = shape.components = shape.boundary_components = shape.charts = faces;
  shape.largest_component = 1;
  shape.positions = shape.edges = shape.boundary_edges = 3 * faces;
  shape.uv_edges = shape.uv_boundary_edges = 3 * faces;
  shape.area = 6 * n;
  shape.boundary_len = 12 * n;
  shape.seam_len = 0;
  shape.longest_side = std::max(4.0, n - 1);
  return shape;
}

/// Answers of `texels` covered texels of a texture, by one chart each or by all charts.
void answer_use(std::uint64_t texels, std::uint64_t side, bool shared, Answers& answers) {
  const auto all = static_cast<double>(side * side);
  answers.values["occupancy"] = static_cast<double>(texels) / all;
  answers.values["overlap_within_chart_texels"] = 0;
  answers.values["overlap_between_charts_texels"] = shared ? texels : 0;
}

constexpr std::uint64_t kSide = 4096;

/// Few, as each costs all texels.
std::uint64_t few_faces(std::uint64_t size) {
  return std::max<std::uint64_t>(1, size / 10'000);
}

constexpr UvTriangle kWhole{{{0, 0}, {2, 0}, {0, 2}}};

void write_whole_textures(std::uint64_t size, const std::string& stem) {
  write_loose_faces(few_faces(size), stem, [](std::uint64_t) { return kWhole; });
}

Answers whole_textures_answers(std::uint64_t size) {
  const std::uint64_t faces = few_faces(size);
  const auto n = static_cast<double>(faces);
  Shape shape = loose_shape(faces);
  shape.outside = faces;
  shape.area_uv = n * 2 * kSide * kSide;
  shape.boundary_len_uv = n * kSide * (4 + 2 * sqrt2);
  Answers answers = answers_of(shape);
  answer_use(kSide * kSide, kSide, faces > 1, answers);
  answer_levels(
      0, kSide, faces, [](auto side, unsigned) { return whole_cover(side); }, answers);
  return answers;
}

/// With legs of two texels it covers the one texel in the corner.
constexpr double kTwoTexels = 2.0 / kSide;
constexpr UvTriangle kOneTexel{{{0, 0}, {kTwoTexels, 0}, {0, kTwoTexels}}};

void write_one_texel(std::uint64_t size, const std::string& stem) {
  write_loose_faces(size, stem, [](std::uint64_t) { return kOneTexel; });
}

Answers one_texel_answers(std::uint64_t size) {
  const auto n = static_cast<double>(size);
  Shape shape = loose_shape(size);
  shape.area_uv = 2 * n;
  shape.boundary_len_uv = n * (4 + 2 * sqrt2);
  Answers answers = answers_of(shape);
  answer_use(1, kSide, true, answers);
  answer_levels(
      0, kSide, size, [](auto, unsigned level) { return corner_cover(2U >> level); }, answers);
  return answers;
}

/// Close to the largest float, as a power of two: areas of such triangles are exact.
constexpr double kFar = 0x1p126;
constexpr UvTriangle kFarTriangle{{{-kFar, -kFar}, {kFar, -kFar}, {0, kFar}}};
constexpr std::uint64_t kQuarter = kSide / 4;
constexpr UvTriangle kQuarterTriangle{{{0, 0}, {0.25, 0}, {0, 0.25}}};

std::uint64_t near_faces(std::uint64_t size) {
  return std::max<std::uint64_t>(1, size / 1000);
}

void write_far_uvs(std::uint64_t size, const std::string& stem) {
  write_loose_faces(size, stem, [near = near_faces(size)](std::uint64_t i) {
    return i < near ? kQuarterTriangle : kFarTriangle;
  });
}

Answers far_uvs_answers(std::uint64_t size) {
  const std::uint64_t near = near_faces(size);
  const auto n = static_cast<double>(near), far = static_cast<double>(size - near);
  const double far_texels = kFar * kSide;
  Shape shape = loose_shape(size);
  shape.outside = size - near;
  shape.area_uv = n * kQuarter * kQuarter / 2 + far * 2 * far_texels * far_texels;
  shape.boundary_len_uv = n * kQuarter * (2 + sqrt2) + far * 2 * far_texels * (1 + std::sqrt(5.0));
  Answers answers = answers_of(shape);
  answers.values["uv_far"] = size - near;
  answer_use(corner_cover(kQuarter).covered, kSide, near > 1, answers);
  answer_levels(
      0, kSide, near, [](auto, unsigned level) { return corner_cover(kQuarter >> level); },
      answers);
  return answers;
}

/// None of them covers the centre of a texel on any level: a point, a line along the
/// diagonal, half a texel, and a line that only snapping makes one.
constexpr std::array<UvTriangle, 4> kNothing{
    {{{{0.3, 0.3}, {0.3, 0.3}, {0.3, 0.3}}},
     {{{0, 0}, {1.0 / 32, 1.0 / 32}, {1.0 / 16, 1.0 / 16}}},
     {{{0, 0}, {1.0 / kSide, 0}, {0, 1.0 / kSide}}},
     {{{0, 0.5 / kSide}, {1.0 / 16, 0.5 / kSide}, {1.0 / 16, (0.5 + 1.0 / 1024) / kSide}}}}};

void write_no_texels(std::uint64_t size, const std::string& stem) {
  write_loose_faces(size / 4 * 4, stem, [](std::uint64_t i) { return kNothing[i % 4]; });
}

Answers no_texels_answers(std::uint64_t size) {
  const std::uint64_t of_each = size / 4;
  const auto n = static_cast<double>(of_each);
  Shape shape = loose_shape(4 * of_each);
  shape.null_charts = 2 * of_each;
  constexpr double kLine = kSide / 16.0;
  shape.area_uv = n * (0.5 + kLine / 1024 / 2);
  shape.boundary_len_uv =
      n * (2 * sqrt2 * kLine + (2 + sqrt2) + kLine + 1.0 / 1024 + std::hypot(kLine, 1.0 / 1024));
  Answers answers = answers_of(shape);
  answer_use(0, kSide, false, answers);
  answers.values["occupancy"] = nullptr;
  answer_levels(
      0, kSide, 1, [](auto, unsigned) { return LevelCover{}; }, answers);
  return answers;
}

constexpr std::uint64_t kHugeSide = 65'536;

/// Below the diagonal of the texture by no more than a texel: every level of tiles is touched from
/// corner to corner.
constexpr UvTriangle kSliver{{{0, 0}, {1, 1 - 1.0 / kHugeSide}, {1, 1}}};

void write_slivers(std::uint64_t size, const std::string& stem) {
  write_loose_faces(few_faces(size), stem, [](std::uint64_t) { return kSliver; });
}

Answers slivers_answers(std::uint64_t size) {
  const std::uint64_t faces = few_faces(size);
  const auto n = static_cast<double>(faces);
  constexpr double kTexels = kHugeSide;
  Shape shape = loose_shape(faces);
  shape.area_uv = n * kTexels / 2;
  shape.boundary_len_uv = n * (kTexels * sqrt2 + 1 + std::hypot(kTexels, kTexels - 1));
  Answers answers = answers_of(shape);
  answer_use(kHugeSide, kHugeSide, faces > 1, answers);
  // One texel of level 0 is half a unit of level 9, and snaps to none.
  const auto cover_of = [](std::uint64_t side, unsigned level) {
    return level < 9 ? diagonal_cover(side) : LevelCover{};
  };
  answer_levels(0, kHugeSide, faces, cover_of, answers);
  return answers;
}

/// Squares along the diagonal, of two faces each.
constexpr std::uint64_t kSquareTexels = 32;
constexpr std::uint64_t kSquareStepTexels = 4 * kSquareTexels;
/// The next would snap to the centre of a texel of level 14.
constexpr std::uint64_t kMostSquares = 62;

std::uint64_t squares_of(std::uint64_t size) {
  return std::clamp<std::uint64_t>(size / 1000, 1, kMostSquares);
}

void write_huge_texture(std::uint64_t size, const std::string& stem) {
  ObjFile obj(stem);
  for (std::uint64_t i = 0; i < squares_of(size); ++i) {
    const std::uint64_t first = (i + 1) * kSquareStepTexels + kSquareTexels;
    const auto low = static_cast<double>(first) / kHugeSide;
    const auto high = static_cast<double>(first + kSquareTexels) / kHugeSide;
    for (const auto& [x, y] : {std::array{0U, 0U}, {3U, 0U}, {3U, 4U}, {0U, 4U}}) {
      obj.put_vertex(x, y, i);
      put_uv({x == 0 ? low : high, y == 0 ? low : high}, obj);
    }
    const std::array lower{4 * i, 4 * i + 1, 4 * i + 2}, upper{4 * i, 4 * i + 2, 4 * i + 3};
    obj.put_face(lower, lower);
    obj.put_face(upper, upper);
  }
  obj.close();
}

/// Where a square is one texel, the next is four further. One level on it is half a texel that
/// begins with the centre of one, and shares a neighbour with the next; beyond there is nothing.
Answers huge_texture_answers(std::uint64_t size) {
  const std::uint64_t squares = squares_of(size);
  const auto n = static_cast<double>(squares);
  Shape shape;
  shape.faces = 2 * squares;
  shape.positions = 4 * squares;
  shape.edges = shape.uv_edges = 5 * squares;
  shape.boundary_edges = shape.uv_boundary_edges = 4 * squares;
  shape.components = shape.boundary_components = shape.charts = squares;
  shape.largest_component = 2;
  shape.area = 12 * n;
  shape.boundary_len = 14 * n;
  shape.seam_len = 0;
  shape.area_uv = n * kSquareTexels * kSquareTexels;
  shape.boundary_len_uv = n * 4 * kSquareTexels;
  shape.longest_side = std::max(4.0, n - 1);
  Answers answers = answers_of(shape);
  answer_use(squares * kSquareTexels * kSquareTexels, kHugeSide, false, answers);
  const auto cover_of = [squares](std::uint64_t, unsigned level) -> LevelCover {
    if (2 * kSquareTexels >> level == 1) return {squares, 8 * squares + 1, squares};
    const LevelCover one = square_cover(kSquareTexels >> level);
    return {squares * one.covered, squares * one.bilinear, squares * one.boundary};
  };
  answer_levels(0, kHugeSide, 1, cover_of, answers);
  return answers;
}

constexpr ImageSize kTexture{kSide, kSide};
constexpr ImageSize kHugeTexture{kHugeSide, kHugeSide};

}  // namespace

std::vector<WorstCase> atlas_cases() {
  return {
      {"whole_textures", "texels: each of its few faces covers all of the texture", "faces",
       write_whole_textures, whole_textures_answers, kTexture},
      {"one_texel", "tiles: all faces are on one texel", "faces", write_one_texel,
       one_texel_answers, kTexture},
      {"far_uvs", "UVs near the largest float, and a few beside zero", "faces", write_far_uvs,
       far_uvs_answers, kTexture},
      {"no_texels", "faces that cover no texel: points, lines, parts of a texel", "faces",
       write_no_texels, no_texels_answers, kTexture},
      {"slivers", "tiles: each of its few faces runs through all along the diagonal", "faces",
       write_slivers, slivers_answers, kHugeTexture},
      {"huge_texture", "tiles: millions of them, few with a face", "faces", write_huge_texture,
       huge_texture_answers, kHugeTexture},
  };
}

}  // namespace atlasgauge
