#include "bench/site.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>
#include <utility>

#include "bench/images.hpp"
#include "bench/permutation.hpp"
#include "bench/site_texels.hpp"
#include "bench/text_file.hpp"
#include "io/error.hpp"

namespace atlasgauge {
namespace {

constexpr int kMostDecimals = 15;
constexpr std::uint64_t kGapTexels = 4;
constexpr std::uint64_t kScaleUnits = 64;     ///< of Site::scale_ in a texel
constexpr std::uint64_t kSmallestScale = 16;  ///< a quarter texel a quad
constexpr std::uint32_t kSmallestSize = 16;
constexpr std::uint32_t kLargestSize = 65536;  ///< with 1/128 texels: 23 of a float's 24 bits
constexpr std::uint32_t kLargestJpegSize = 32768;

/// A profile repeats after 16 columns: +1 is a ramp up, -1 a ramp down.
constexpr std::array<int, 16> kProfile{0, 0, 1, 1, 1, 0, 0, -1, 0, 0, 0, -1, -1, 0, 0, 0};
constexpr std::int64_t kRampRise = 3;

/// Halves of the full scale, along u and v.
constexpr std::array<std::array<std::uint64_t, 2>, Site::kScaleClasses> kScaleHalves{
    {{2, 2}, {1, 1}, {1, 2}, {2, 1}}};

/// Sums over one period before each column: of ramps, and of their rises.
struct ProfileSums {
  std::array<std::uint64_t, kProfile.size() + 1> ramps{};
  std::array<std::int64_t, kProfile.size() + 1> rises{};
};

constexpr ProfileSums profile_sums() {
  ProfileSums sums;
  for (std::size_t i = 0; i < kProfile.size(); ++i) {
    sums.ramps[i + 1] = sums.ramps[i] + (kProfile[i] != 0 ? 1 : 0);
    sums.rises[i + 1] = sums.rises[i] + kRampRise * kProfile[i];
  }
  return sums;
}

constexpr ProfileSums kProfileSums = profile_sums();
static_assert(kProfileSums.rises.back() == 0, "the ground must not climb for ever");

void require(bool condition, const std::string& text) {
  if (!condition) throw Error(ErrorKind::kUsage, text);
}

void check(const SiteOptions& options) {
  require(options.textures > 0, "a site needs at least one texture");
  require(options.image_format != ImageFormat::kNone || options.textures == 1,
          "without images a model has one texture slot: ask for one texture");
  require(options.faces >= 2 * std::uint64_t{options.textures},
          fmt::format("{} faces for {} textures: at least two faces a texture are needed",
                      options.faces, options.textures));
  require(std::has_single_bit(options.texture_size_texels) &&
              options.texture_size_texels >= kSmallestSize &&
              options.texture_size_texels <= kLargestSize,
          fmt::format("texture size {}: a power of two from {} to {} is needed",
                      options.texture_size_texels, kSmallestSize, kLargestSize));
  require(
      options.image_format != ImageFormat::kJpg || options.texture_size_texels <= kLargestJpegSize,
      fmt::format("a JPEG has at most {} texels a side here", kLargestJpegSize));
  require(options.chart_side_min_quads > 0 &&
              options.chart_side_max_quads / 2 >= options.chart_side_min_quads,
          "the longest side of a chart must be at least twice the shortest");
  require(options.decimals >= 6 && options.decimals <= kMostDecimals,
          fmt::format("decimals must be from 6 to {}", kMostDecimals));
}

std::uint32_t texture_columns(std::uint32_t textures) {
  auto columns = static_cast<std::uint32_t>(std::sqrt(static_cast<double>(textures)));
  while (textures % columns != 0) --columns;
  return columns;
}

/// Sides of the nearly square piece of ground that one texture covers.
std::uint64_t texture_width_quads(const SiteOptions& options) {
  const double quads = static_cast<double>(options.faces) / (2.0 * options.textures);
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(std::sqrt(quads))));
}

std::uint64_t texture_height_quads(const SiteOptions& options) {
  const std::uint64_t row = 2 * texture_width_quads(options) * options.textures;
  return std::max<std::uint64_t>(1, (options.faces + row / 2) / row);
}

const SiteOptions& checked(const SiteOptions& options) {
  check(options);
  return options;
}

}  // namespace

// The lattice.

SiteAxis::SiteAxis(std::uint64_t quads_per_texture, std::uint32_t textures,
                   const SiteOptions& options, std::uint64_t seed) {
  for (std::uint32_t texture = 0; texture < textures; ++texture) {
    cut(quads_per_texture, options, mix(seed + texture));
    textures_.resize(charts(), texture);
  }
  for (std::size_t chart = 0; chart < charts(); ++chart) {
    roof_points_.push_back(roof_points_.back() + (roof_line(chart) ? length(chart) + 1 : 0));
  }
}

void SiteAxis::cut(std::uint64_t quads, const SiteOptions& options, std::uint64_t seed) {
  const std::uint64_t shortest = options.chart_side_min_quads;
  const std::uint64_t longest = options.chart_side_max_quads;
  const std::uint64_t end = begins_.back() + quads;
  while (end - begins_.back() > longest) {
    seed = mix(seed);
    const std::uint64_t latest = end - shortest;
    begins_.push_back(
        std::min(latest, begins_.back() + shortest + seed % (longest - shortest + 1)));
  }
  begins_.push_back(end);
}

std::uint64_t SiteAxis::place(std::uint64_t scale) {
  begins_texels_.clear();
  std::uint64_t cursor = 0;
  std::uint64_t fullest = 0;
  for (std::size_t chart = 0; chart < charts(); ++chart) {
    if (chart == 0 || texture(chart) != texture(chart - 1)) cursor = 0;
    begins_texels_.push_back(cursor + kGapTexels / 2);
    cursor += (length(chart) * scale + kScaleUnits - 1) / kScaleUnits + kGapTexels;
    fullest = std::max(fullest, cursor);
  }
  return fullest;
}

std::size_t SiteAxis::chart_of(std::uint64_t quad) const {
  const auto after = std::upper_bound(begins_.begin(), begins_.end(), quad);
  return static_cast<std::size_t>(after - begins_.begin()) - 1;
}

Site::Site(const SiteOptions& options)
    : options_(checked(options)),
      columns_(texture_width_quads(options), texture_columns(options.textures), options, 1),
      rows_(texture_height_quads(options), options.textures / texture_columns(options.textures),
            options, 2),
      scale_(kScaleUnits * options.texture_size_texels /
             std::max(texture_width_quads(options), texture_height_quads(options))) {
  const std::uint64_t size = options.texture_size_texels;
  while (std::max(columns_.place(scale_), rows_.place(scale_)) > size) {
    require(scale_ > kSmallestScale,
            fmt::format("{} textures of {}x{} texels are too small for {} faces", options.textures,
                        size, size, options.faces));
    --scale_;
  }
}

std::uint64_t Site::texcoords() const {
  return (columns_.quads() + columns_.charts()) * (rows_.quads() + rows_.charts());
}

std::uint64_t Site::vertices() const {
  if (options_.duplicate_vertices) return texcoords();
  return ground_vertices() +
         columns_.roof_points_before(columns_.charts()) * rows_.roof_points_before(rows_.charts());
}

SiteChart Site::chart(std::size_t column, std::size_t row) const {
  const std::uint64_t random = mix(mix(column) + row);
  const std::size_t scale_class = random % 8 < 5 ? 0 : random % 8 - 4;
  const auto [u_step, v_step] = quad_texels(scale_class);
  return {.x = columns_.begin(column),
          .y = rows_.begin(row),
          .width = columns_.length(column),
          .height = rows_.length(row),
          .texture = texture(column, row),
          .scale_class = scale_class,
          .u = kTexelUnits * columns_.begin_texels(column),
          .v = kTexelUnits * rows_.begin_texels(row),
          .u_step = u_step,
          .v_step = v_step,
          .mirrored = random / 8 % 8 == 0,
          .roof = columns_.roof_line(column) && rows_.roof_line(row)};
}

SiteFace Site::face(std::uint64_t index) const {
  const std::uint64_t quad = index / 2;
  const std::size_t row = rows_.chart_of(quad / columns_.quads());
  const std::uint64_t in_row = quad - rows_.begin(row) * columns_.quads();
  const std::size_t column = columns_.chart_of(in_row / rows_.length(row));
  const std::uint64_t in_chart = in_row - columns_.begin(column) * rows_.length(row);
  const std::uint64_t i = in_chart % columns_.length(column);
  const std::uint64_t j = in_chart / columns_.length(column);

  constexpr std::array<std::array<std::array<std::uint64_t, 2>, 3>, 2> kTriangles{
      {{{{0, 0}, {1, 0}, {1, 1}}}, {{{0, 0}, {1, 1}, {0, 1}}}}};
  SiteFace face{};
  for (std::size_t k = 0; k < 3; ++k) {
    const auto [di, dj] = kTriangles[index % 2][k];
    face.v[k] = vertex_index(column, row, i + di, j + dj);
    face.t[k] = texcoord_index(column, row, i + di, j + dj);
  }
  face.texture = texture(column, row);
  return face;
}

std::uint32_t Site::texture(std::size_t column, std::size_t row) const {
  const std::uint32_t per_row = columns_.texture(columns_.charts() - 1) + 1;
  return rows_.texture(row) * per_row + columns_.texture(column);
}

std::array<std::uint64_t, 2> Site::quad_texels(std::size_t scale_class) const {
  static_assert(2 * kScaleUnits == kTexelUnits);
  return {scale_ * kScaleHalves[scale_class][0], scale_ * kScaleHalves[scale_class][1]};
}

std::int64_t Site::height(std::uint64_t x) {
  return kProfileSums.rises[x % kProfile.size()];
}

std::uint64_t Site::ramps_before(std::uint64_t x) {
  return x / kProfile.size() * kProfileSums.ramps.back() + kProfileSums.ramps[x % kProfile.size()];
}

std::vector<std::string> Site::texture_names() const {
  if (options_.image_format == ImageFormat::kNone) return {"N/A"};
  const char* const ending = options_.image_format == ImageFormat::kPng ? "png" : "jpg";
  std::vector<std::string> names;
  for (std::uint32_t texture = 0; texture < options_.textures; ++texture) {
    names.push_back(fmt::format("{}_{}.{}", options_.name, texture, ending));
  }
  return names;
}

// A chart of w × h quads has (w + 1)(h + 1) texture coordinates; the sums over the rows before and
// over the charts before in the row factor.
std::uint64_t Site::texcoord_index(std::size_t column, std::size_t row, std::uint64_t i,
                                   std::uint64_t j) const {
  const std::uint64_t in_rows_before =
      (rows_.begin(row) + row) * (columns_.quads() + columns_.charts());
  const std::uint64_t in_charts_before =
      (columns_.begin(column) + column) * (rows_.length(row) + 1);
  return in_rows_before + in_charts_before + j * (columns_.length(column) + 1) + i;
}

std::uint64_t Site::vertex_index(std::size_t column, std::size_t row, std::uint64_t i,
                                 std::uint64_t j) const {
  if (options_.duplicate_vertices) return texcoord_index(column, row, i, j);
  if (columns_.roof_line(column) && rows_.roof_line(row)) return roof_index(column, row, i, j);
  return ground_index(column, row, i, j);
}

// A chart owns the vertices of its lower and left sides; the last ones also own the site's border.
std::uint64_t Site::ground_index(std::size_t column, std::size_t row, std::uint64_t i,
                                 std::uint64_t j) const {
  if (i == columns_.length(column) && column + 1 < columns_.charts())
    return ground_index(column + 1, row, 0, j);
  if (j == rows_.length(row) && row + 1 < rows_.charts())
    return ground_index(column, row + 1, i, 0);
  const std::uint64_t owned_width = columns_.length(column) + (column + 1 == columns_.charts());
  const std::uint64_t owned_height = rows_.length(row) + (row + 1 == rows_.charts());
  return rows_.begin(row) * (columns_.quads() + 1) + columns_.begin(column) * owned_height +
         j * owned_width + i;
}

std::uint64_t Site::roof_index(std::size_t column, std::size_t row, std::uint64_t i,
                               std::uint64_t j) const {
  const std::uint64_t in_rows_before =
      rows_.roof_points_before(row) * columns_.roof_points_before(columns_.charts());
  const std::uint64_t in_charts_before =
      columns_.roof_points_before(column) * (rows_.length(row) + 1);
  return ground_vertices() + in_rows_before + in_charts_before + j * (columns_.length(column) + 1) +
         i;
}

namespace {

/// The last of `count` charts of a line whose `begin(chart)`, ascending, is at most `index`.
template <class Begin>
std::size_t last_chart_from(std::size_t count, std::uint64_t index, Begin begin) {
  std::size_t low = 0;
  for (std::size_t high = count; high - low > 1;) {
    const std::size_t middle = low + (high - low) / 2;
    (begin(middle) <= index ? low : high) = middle;
  }
  return low;
}

}  // namespace

SiteVertex Site::vertex(std::uint64_t index) const {
  if (options_.duplicate_vertices) return own_vertex(index);
  return index < ground_vertices() ? ground_vertex(index) : roof_vertex(index - ground_vertices());
}

SiteVertex Site::own_vertex(std::uint64_t index) const {
  const auto row_begin = [&](std::size_t row) { return texcoord_index(0, row, 0, 0); };
  const std::size_t row = last_chart_from(rows_.charts(), index, row_begin);
  const auto begin = [&](std::size_t column) { return texcoord_index(column, row, 0, 0); };
  const std::size_t column = last_chart_from(columns_.charts(), index, begin);
  const std::uint64_t at = index - begin(column);
  const std::uint64_t width = columns_.length(column) + 1;
  const bool roof = columns_.roof_line(column) && rows_.roof_line(row);
  return {columns_.begin(column) + at % width, rows_.begin(row) + at / width,
          roof ? roof_height() : 0};
}

SiteVertex Site::ground_vertex(std::uint64_t index) const {
  const auto row_begin = [&](std::size_t row) { return ground_index(0, row, 0, 0); };
  const std::size_t row = last_chart_from(rows_.charts(), index, row_begin);
  const auto begin = [&](std::size_t column) { return ground_index(column, row, 0, 0); };
  const std::size_t column = last_chart_from(columns_.charts(), index, begin);
  const std::uint64_t at = index - begin(column);
  const std::uint64_t width = columns_.length(column) + (column + 1 == columns_.charts());
  return {columns_.begin(column) + at % width, rows_.begin(row) + at / width, 0};
}

SiteVertex Site::roof_vertex(std::uint64_t index) const {
  const auto row_begin = [&](std::size_t row) {
    return roof_index(0, row, 0, 0) - ground_vertices();
  };
  const std::size_t row = last_chart_from(rows_.charts(), index, row_begin);
  const auto begin = [&](std::size_t column) {
    return roof_index(column, row, 0, 0) - ground_vertices();
  };
  const std::size_t column = last_chart_from(columns_.charts(), index, begin);
  const std::uint64_t at = index - begin(column);
  const std::uint64_t width = columns_.length(column) + 1;
  return {columns_.begin(column) + at % width, rows_.begin(row) + at / width, roof_height()};
}

// Answers.

namespace {

/// Sums over charts that all answers follow from. Lengths and areas in the site's integer units.
struct Tally {
  std::array<std::uint64_t, Site::kScaleClasses> level_quads{};
  std::array<std::uint64_t, Site::kScaleClasses> ramp_quads{};
  std::vector<std::uint64_t> covered_texels;  ///< by texture
  std::uint64_t sides = 0;                    ///< quad sides on the charts' borders
  std::uint64_t border = 0;                   ///< their length
  std::uint64_t border_uv = 0;
  std::uint64_t area_uv = 0;
  std::uint64_t largest_quads = 0;

  std::uint64_t roofs = 0;
  std::uint64_t roof_quads = 0;
  std::uint64_t roof_sides = 0;
  std::uint64_t roof_border = 0;
  std::uint64_t roof_largest_quads = 0;
  std::uint64_t covered_vertices = 0;  ///< left on the ground under roofs
  std::int64_t highest_roof = 0;
};

/// Texel centres in [begin, begin + length), begin on a texel's border: the fill rule takes the
/// left and lower sides, and the corners need no snapping to 1/256.
std::uint64_t centres(std::uint64_t length) {
  return (length + Site::kTexelUnits / 2 - 1) / Site::kTexelUnits;
}

std::int64_t highest(std::uint64_t x_begin, std::uint64_t x_last) {
  std::int64_t top = Site::height(x_begin);
  const std::uint64_t last = std::min(x_last, x_begin + kProfile.size());
  for (std::uint64_t x = x_begin; x <= last; ++x) top = std::max(top, Site::height(x));
  return top;
}

void add_roof(const SiteChart& chart, std::uint64_t border, Tally& tally) {
  const std::uint64_t quads = chart.width * chart.height;
  tally.roofs += 1;
  tally.roof_quads += quads;
  tally.roof_sides += 2 * (chart.width + chart.height);
  tally.roof_border += border;
  tally.roof_largest_quads = std::max(tally.roof_largest_quads, quads);
  tally.covered_vertices += (chart.width - 1) * (chart.height - 1);
  tally.highest_roof =
      std::max(tally.highest_roof, highest(chart.x, chart.x + chart.width) + Site::roof_height());
}

void add_chart(const SiteChart& chart, Tally& tally) {
  const std::uint64_t ramps =
      Site::ramps_before(chart.x + chart.width) - Site::ramps_before(chart.x);
  const std::uint64_t border =
      2 * (Site::kStep * (chart.width + chart.height) + ramps * (Site::kRampLength - Site::kStep));
  const std::uint64_t width_uv = chart.width * chart.u_step;
  const std::uint64_t height_uv = chart.height * chart.v_step;
  tally.level_quads[chart.scale_class] += (chart.width - ramps) * chart.height;
  tally.ramp_quads[chart.scale_class] += ramps * chart.height;
  tally.covered_texels[chart.texture] += centres(width_uv) * centres(height_uv);
  tally.sides += 2 * (chart.width + chart.height);
  tally.border += border;
  tally.border_uv += 2 * (width_uv + height_uv);
  tally.area_uv += width_uv * height_uv;
  tally.largest_quads = std::max(tally.largest_quads, chart.width * chart.height);
  if (chart.roof) add_roof(chart, border, tally);
}

Tally tally_charts(const Site& site) {
  Tally tally;
  tally.covered_texels.resize(site.options().textures);
  for (std::size_t row = 0; row < site.rows().charts(); ++row) {
    for (std::size_t column = 0; column < site.columns().charts(); ++column) {
      add_chart(site.chart(column, row), tally);
    }
  }
  return tally;
}

double length_3d(std::uint64_t units) {
  return static_cast<double>(units) / static_cast<double>(Site::kLengthUnits);
}

double area_3d(std::uint64_t square_units) {
  constexpr double kSquareUnits = 1.0 * Site::kLengthUnits * Site::kLengthUnits;
  return static_cast<double>(square_units) / kSquareUnits;
}

double length_texels(std::uint64_t units) {
  return static_cast<double>(units) / static_cast<double>(Site::kTexelUnits);
}

double area_texels(std::uint64_t square_units) {
  constexpr double kSquareUnits = 1.0 * Site::kTexelUnits * Site::kTexelUnits;
  return static_cast<double>(square_units) / kSquareUnits;
}

double site_area(const Site& site) {
  const std::uint64_t columns = site.columns().quads();
  const std::uint64_t width =
      Site::kStep * columns + Site::ramps_before(columns) * (Site::kRampLength - Site::kStep);
  return area_3d(width * Site::kStep * site.rows().quads());
}

/// Of the border of the ground's lattice, without holes.
std::uint64_t site_border(const Site& site) {
  const std::uint64_t columns = site.columns().quads();
  const std::uint64_t ramps = Site::ramps_before(columns);
  return 2 * (Site::kStep * (columns + site.rows().quads()) +
              ramps * (Site::kRampLength - Site::kStep));
}

double longest_side(const Site& site, const Tally& tally) {
  const std::uint64_t across = Site::kStep * std::max(site.columns().quads(), site.rows().quads());
  const std::int64_t top = std::max(highest(0, site.columns().quads()), tally.highest_roof);
  return length_3d(std::max(across, static_cast<std::uint64_t>(top)));
}

/// Raw level, vertices shared between charts: one sheet with a hole under every roof.
nlohmann::json shared_topology(const Site& site, const Tally& tally) {
  const std::uint64_t nx = site.columns().quads();
  const std::uint64_t ny = site.rows().quads();
  const std::uint64_t ground_quads = nx * ny - tally.roof_quads;
  return {{"en", 3 * nx * ny + nx + ny + tally.roof_sides},
          {"en_b", 2 * (nx + ny) + 2 * tally.roof_sides},
          {"boundary_len", length_3d(site_border(site) + 2 * tally.roof_border)},
          {"connected_components", 1 + tally.roofs},
          {"boundary_loops", 1 + 2 * tally.roofs},
          {"boundary_components", 1 + 2 * tally.roofs},
          {"euler", 1},  // (1 - roofs) for the sheet with holes, 1 for each roof
          {"largest_component_fn", 2 * std::max(ground_quads, tally.roof_largest_quads)},
          {"vnunref", tally.covered_vertices},
          {"vndup", 0}};
}

/// Raw level, every chart a disk of its own.
nlohmann::json duplicated_topology(const Site& site, const Tally& tally) {
  const std::uint64_t quads = site.columns().quads() * site.rows().quads();
  const std::uint64_t lattice = (site.columns().quads() + 1) * (site.rows().quads() + 1);
  const std::uint64_t positions = lattice - tally.covered_vertices +
                                  site.columns().roof_points_before(site.columns().charts()) *
                                      site.rows().roof_points_before(site.rows().charts());
  return {{"en", 3 * quads + tally.sides / 2},
          {"en_b", tally.sides},
          {"boundary_len", length_3d(tally.border)},
          {"connected_components", site.charts()},
          {"boundary_loops", site.charts()},
          {"boundary_components", site.charts()},
          {"euler", site.charts()},
          {"largest_component_fn", 2 * tally.largest_quads},
          {"vnunref", 0},
          {"vndup", site.vertices() - positions}};
}

void add_mesh(const Site& site, const Tally& tally, nlohmann::json& values) {
  values.update(site.options().duplicate_vertices ? duplicated_topology(site, tally)
                                                  : shared_topology(site, tally));
  values["mesh"] = site.options().name + ".obj";
  values["fn"] = site.faces();
  values["vn"] = site.vertices();
  values["genus"] = 0;
  values["oriented"] = true;
  values["orientable"] = true;
  for (const char* key : {"nonmanif_edge", "nonmanif_vert", "fndup", "fnzero", "fndegen",
                          "faces_invalid", "faces_nonfinite"}) {
    values[key] = 0;
  }
  const double side = longest_side(site, tally);
  values["area"] = site_area(site);
  values["area_normalized"] = site_area(site) / (side * side);
  values["boundary_len_normalized"] = values["boundary_len"].get<double>() / side;
}

/// Every side of a chart lies on the site's border, beside a hole, around a roof, or on a seam with
/// another chart's; the last are counted twice.
void add_seams(const Site& site, const Tally& tally, nlohmann::json& values) {
  const std::uint64_t outer = 2 * (site.columns().quads() + site.rows().quads());
  const std::uint64_t seams = (tally.sides - outer) / 2 - tally.roof_sides;
  const std::uint64_t length = (tally.border - site_border(site)) / 2 - tally.roof_border;
  const bool images = site.options().image_format != ImageFormat::kNone;
  values["seam_edges"] = seams;
  values["seam_len"] = length_3d(length);
  values["seam_edges_unsampled"] = images ? 0 : seams;
}

double occupancy(const Site& site, const Tally& tally) {
  const double texels = std::pow(site.options().texture_size_texels, 2);
  double covered = 0;
  double available = 0;
  for (const std::uint64_t count : tally.covered_texels) {
    covered += static_cast<double>(count);
    available += count > 0 ? texels : 0;
  }
  return covered / available;
}

void add_atlas(const Site& site, const Tally& tally, nlohmann::json& values) {
  const std::uint64_t quads = site.columns().quads() * site.rows().quads();
  const double area_uv = area_texels(tally.area_uv);
  const double boundary_uv = length_texels(tally.border_uv);
  const double crumbliness = boundary_uv / std::sqrt(4 * std::numbers::pi * area_uv);
  values["num_charts"] = site.charts();
  values["en_uv"] = 3 * quads + tally.sides / 2;
  values["en_uv_b"] = tally.sides;
  values["area_uv"] = area_uv;
  values["boundary_len_uv"] = boundary_uv;
  values["crumbliness"] = crumbliness;
  values["solidity"] = 1 / crumbliness;
  values["mapped_fraction"] = 1.0;
  values["occupancy"] = occupancy(site, tally);
  values["ntex"] = site.texture_names().size();
  values["textures"] = site.texture_names();
  for (const char* key : {"num_null_charts", "nfolds", "faces_unmapped", "faces_untextured",
                          "faces_uv_outside", "uv_far", "charts_nonorientable",
                          "overlap_within_chart_texels", "overlap_between_charts_texels"}) {
    values[key] = 0;
  }
}

/// The texel centres between two borders of a chart, in kTexelUnits of level 0: corners snap to
/// 1/256 of a texel of the level, and what lies between two of them belongs to the first.
std::pair<std::int64_t, std::int64_t> texels_between(std::uint64_t begin, std::uint64_t end,
                                                     int level) {
  constexpr int kSnapUnits = 256;
  const auto first_centre_from = [level](std::uint64_t units) {
    const double texels = static_cast<double>(units) / Site::kTexelUnits;
    const std::int64_t snapped = std::llrint(std::ldexp(texels * kSnapUnits, -level));
    return (snapped + kSnapUnits / 2 - 1) / kSnapUnits;
  };
  return {first_centre_from(begin), first_centre_from(end)};
}

/// Where a chart lies, in kTexelUnits of level 0.
struct UvRect {
  std::uint64_t left, right, bottom, top;
};

std::vector<std::vector<UvRect>> charts_by_texture(const Site& site) {
  std::vector<std::vector<UvRect>> textures(site.options().textures);
  for (std::size_t row = 0; row < site.rows().charts(); ++row) {
    for (std::size_t column = 0; column < site.columns().charts(); ++column) {
      const SiteChart chart = site.chart(column, row);
      textures[chart.texture].push_back({chart.u, chart.u + chart.width * chart.u_step, chart.v,
                                         chart.v + chart.height * chart.v_step});
    }
  }
  return textures;
}

/// Quads are cells between snapped lines, so a chart covers a rectangle once, and no two charts
/// share a texel.
std::vector<TexelRect> texels_of(const std::vector<UvRect>& charts, int level) {
  std::vector<TexelRect> rects;
  for (const UvRect& chart : charts) {
    const auto [left, right] = texels_between(chart.left, chart.right, level);
    const auto [bottom, top] = texels_between(chart.bottom, chart.top, level);
    rects.push_back({left, right, bottom, top});
  }
  return rects;
}

nlohmann::json level_json(const TexelCounts& counts, std::uint32_t size) {
  return {{"rw", size},
          {"rh", size},
          {"totalTexels", counts.covered},
          {"totalTexels_bilinear", counts.bilinear},
          {"overwrittenTexels", 0},
          {"lostTexels", 0},
          {"boundaryTexels", counts.boundary},
          {"texelClashes", counts.clashes}};
}

void add_textures(const Site& site, nlohmann::json& values) {
  int texture = 0;
  for (const std::vector<UvRect>& charts : charts_by_texture(site)) {
    nlohmann::json& levels = values[fmt::format("texture_{}", texture++)] = nlohmann::json::array();
    std::uint32_t size = site.options().texture_size_texels;
    for (int level = 0; size > 0; ++level, size /= 2) {
      levels.push_back(level_json(count_texels(texels_of(charts, level), size), size));
    }
  }
}

struct WeightedValue {
  double value;
  std::uint64_t weight;
};

/// One kind of quad: a scale class on level ground or on a ramp.
struct QuadKind {
  double length;              ///< along the profile, in length units; along y it is kStep
  double u_texels, v_texels;  ///< sides in the texture
  std::uint64_t weight;       ///< total area over kStep, in length units: an integer
};

std::vector<QuadKind> quad_kinds(const Site& site, const Tally& tally) {
  std::vector<QuadKind> kinds;
  for (std::size_t i = 0; i < Site::kScaleClasses; ++i) {
    const auto [u, v] = site.quad_texels(i);
    for (const auto& [length, quads] : {std::pair{Site::kStep, tally.level_quads[i]},
                                        std::pair{Site::kRampLength, tally.ramp_quads[i]}}) {
      if (quads == 0) continue;
      kinds.push_back(
          {static_cast<double>(length), length_texels(u), length_texels(v), length * quads});
    }
  }
  return kinds;
}

/// s_max / s_min; the Jacobian of a quad is diagonal.
double distortion(const QuadKind& kind) {
  const double ratio = (kind.u_texels / kind.length) / (kind.v_texels / Site::kStep);
  return std::max(ratio, 1 / ratio);
}

/// Texels² per square model unit.
double scaling(const QuadKind& kind) {
  constexpr double kSquareUnits = 1.0 * Site::kLengthUnits * Site::kLengthUnits;
  return kind.u_texels * kind.v_texels * kSquareUnits / (kind.length * Site::kStep);
}

/// A right triangle: the angle opposite its shorter leg.
double smallest_angle_degrees(const QuadKind& kind) {
  static_assert(Site::kRampLength > Site::kStep);
  return std::atan2(Site::kStep, kind.length) * 180 / std::numbers::pi;
}

template <class Value>
std::vector<WeightedValue> distribution(const std::vector<QuadKind>& kinds, Value value) {
  std::vector<WeightedValue> values;
  for (const QuadKind& kind : kinds) values.push_back({value(kind), kind.weight});
  std::sort(values.begin(), values.end(),
            [](const auto& a, const auto& b) { return a.value < b.value; });
  return values;
}

std::uint64_t total_weight(const std::vector<WeightedValue>& values) {
  std::uint64_t total = 0;
  for (const WeightedValue& v : values) total += v.weight;
  return total;
}

/// Weights are integers, so the comparison at the percentile is exact.
double percentile(const std::vector<WeightedValue>& values, std::uint64_t percent) {
  const std::uint64_t total = total_weight(values);
  std::uint64_t sum = 0;
  for (const WeightedValue& v : values) {
    sum += v.weight;
    if (sum * 100 >= percent * total) return v.value;
  }
  return values.back().value;
}

/// Mean of f(value).
template <class Function>
double mean(const std::vector<WeightedValue>& values, Function f) {
  double sum = 0;
  for (const WeightedValue& v : values) sum += static_cast<double>(v.weight) * f(v.value);
  return sum / static_cast<double>(total_weight(values));
}

double variance(const std::vector<WeightedValue>& values) {
  const double average = mean(values, [](double x) { return x; });
  return mean(values, [average](double x) { return (x - average) * (x - average); });
}

void add_statistics(const std::string& name, const std::vector<WeightedValue>& data,
                    nlohmann::json& values) {
  for (const std::uint64_t percent : {1, 10, 20, 30, 40, 50, 60, 70, 80, 90, 99}) {
    values[fmt::format("{}_perc{}", name, percent)] = percentile(data, percent);
  }
  values[name + "_min"] = data.front().value;
  values[name + "_max"] = data.back().value;
  values[name + "_avg"] = mean(data, [](double x) { return x; });
  values[name + "_rms"] = std::sqrt(mean(data, [](double x) { return x * x; }));
  values[name + "_var"] = variance(data);
  values[name + "_stddev"] = std::sqrt(variance(data));
}

/// No face is cut from qcd (2.5 at most) or from sf (a few times the mean at most).
void add_distributions(const Site& site, const Tally& tally, nlohmann::json& values) {
  const std::vector<QuadKind> kinds = quad_kinds(site, tally);
  const double mean_scaling = area_texels(tally.area_uv) / site_area(site);
  const auto sf =
      distribution(kinds, [=](const QuadKind& kind) { return scaling(kind) / mean_scaling; });
  add_statistics("qcd", distribution(kinds, distortion), values);
  add_statistics("conformality",
                 distribution(kinds, [](const QuadKind& kind) { return 1 / distortion(kind); }),
                 values);
  add_statistics("sf", sf, values);
  add_statistics("texel_density",
                 distribution(kinds, [](const QuadKind& kind) { return std::sqrt(scaling(kind)); }),
                 values);
  add_statistics("angle_min", distribution(kinds, smallest_angle_degrees), values);
  values["sf_untrimmed_avg"] = values["sf_avg"];
  values["sf_untrimmed_var"] = values["sf_var"];
  values["qcd_discardedArea"] = 0.0;
  values["sf_discardedArea"] = 0.0;
}

}  // namespace

Answers site_answers(const Site& site) {
  const Tally tally = tally_charts(site);
  Answers answers;
  add_mesh(site, tally, answers.values);
  add_atlas(site, tally, answers.values);
  add_textures(site, answers.values);
  add_seams(site, tally, answers.values);
  add_distributions(site, tally, answers.values);
  answers.exact_keys = {"area",     "boundary_len",    "area_uv",           "boundary_len_uv",
                        "seam_len", "mapped_fraction", "qcd_discardedArea", "sf_discardedArea"};
  return answers;
}

// Files.

namespace {

/// A length in 64ths; they end after six decimals.
void put_length(std::int64_t units, int decimals, TextFile& file) {
  static_assert(Site::kLengthUnits * 15625 == 1'000'000);
  if (units < 0) file.put('-');
  const auto size = static_cast<std::uint64_t>(std::abs(units));
  file.put(size / Site::kLengthUnits);
  std::array<char, 1 + kMostDecimals> fraction;
  fraction.fill('0');
  fraction[0] = '.';
  std::uint64_t millionths = size % Site::kLengthUnits * 15625;
  for (std::size_t i = 6; i > 0; --i, millionths /= 10) {
    fraction[i] = static_cast<char>('0' + millionths % 10);
  }
  file.put(std::string_view(fraction.data(), 1 + static_cast<std::size_t>(decimals)));
}

template <class Visit>
void for_each_chart(const Site& site, Visit visit) {
  for (std::size_t row = 0; row < site.rows().charts(); ++row) {
    for (std::size_t column = 0; column < site.columns().charts(); ++column) {
      visit(site.chart(column, row), column, row);
    }
  }
}

/// The site's centre is the origin.
void put_vertex(const Site& site, const SiteVertex& vertex, TextFile& obj) {
  const int decimals = site.options().decimals;
  const auto centred = [](std::uint64_t at, const SiteAxis& axis) {
    return static_cast<std::int64_t>(Site::kStep * at) -
           static_cast<std::int64_t>(Site::kStep / 2 * axis.quads());
  };
  obj.put("v ");
  put_length(centred(vertex.x, site.columns()), decimals, obj);
  obj.put(' ');
  put_length(centred(vertex.y, site.rows()), decimals, obj);
  obj.put(' ');
  put_length(Site::height(vertex.x) + vertex.lift, decimals, obj);
  obj.put('\n');
}

/// Lattice points [x, x + width) × [y, y + height).
void put_vertices(const Site& site, std::uint64_t x, std::uint64_t y, std::uint64_t width,
                  std::uint64_t height, std::int64_t lift, TextFile& obj) {
  for (std::uint64_t j = y; j < y + height; ++j) {
    for (std::uint64_t i = x; i < x + width; ++i) put_vertex(site, {i, j, lift}, obj);
  }
}

void put_shared_vertices(const Site& site, TextFile& obj) {
  for_each_chart(site, [&](const SiteChart& chart, std::size_t column, std::size_t row) {
    const bool last_column = column + 1 == site.columns().charts();
    const bool last_row = row + 1 == site.rows().charts();
    put_vertices(site, chart.x, chart.y, chart.width + last_column, chart.height + last_row, 0,
                 obj);
  });
  for_each_chart(site, [&](const SiteChart& chart, std::size_t, std::size_t) {
    if (!chart.roof) return;
    put_vertices(site, chart.x, chart.y, chart.width + 1, chart.height + 1, Site::roof_height(),
                 obj);
  });
}

void put_own_vertices(const Site& site, TextFile& obj) {
  for_each_chart(site, [&](const SiteChart& chart, std::size_t, std::size_t) {
    put_vertices(site, chart.x, chart.y, chart.width + 1, chart.height + 1,
                 chart.roof ? Site::roof_height() : 0, obj);
  });
}

/// Shortest text that reads back as the same float, behind a blank.
std::string texcoord_text(float number) {
  std::array<char, 64> text{' '};
  char* const end = text.data() + text.size();
  return {text.data(), std::to_chars(text.data() + 1, end, number, std::chars_format::fixed).ptr};
}

/// Texts of `count` coordinates, `step` apart.
std::vector<std::string> texcoord_texts(std::uint64_t begin, std::uint64_t step,
                                        std::uint64_t count, std::uint32_t size_texels) {
  const float units = static_cast<float>(Site::kTexelUnits * size_texels);
  std::vector<std::string> texts;
  for (std::uint64_t i = 0; i < count; ++i) {
    texts.push_back(texcoord_text(static_cast<float>(begin + i * step) / units));
  }
  return texts;
}

void put_texcoords(const Site& site, TextFile& obj) {
  const std::uint32_t size = site.options().texture_size_texels;
  for_each_chart(site, [&](const SiteChart& chart, std::size_t, std::size_t) {
    auto us = texcoord_texts(chart.u, chart.u_step, chart.width + 1, size);
    if (chart.mirrored) std::reverse(us.begin(), us.end());
    for (const std::string& v : texcoord_texts(chart.v, chart.v_step, chart.height + 1, size)) {
      for (const std::string& u : us) {
        obj.put("vt");
        obj.put(u);
        obj.put(v);
        obj.put('\n');
      }
    }
  });
}

void put_face(const SiteFace& face, TextFile& obj) {
  obj.put('f');
  for (std::size_t k = 0; k < 3; ++k) {
    obj.put(' ');
    obj.put(face.v[k] + 1);
    obj.put('/');
    obj.put(face.t[k] + 1);
  }
  obj.put('\n');
}

/// Where faces and vertices stand in the file.
class SiteOrder {
 public:
  explicit SiteOrder(const Site& site) {
    const SiteOptions& options = site.options();
    if (options.shuffle_seed) faces_.emplace(site.faces(), *options.shuffle_seed);
    if (options.vertex_shuffle_seed) {
      vertices_.emplace(site.vertices(), *options.vertex_shuffle_seed);
    }
  }

  bool shuffles_vertices() const { return vertices_.has_value(); }
  std::uint64_t face_at(std::uint64_t place) const { return faces_ ? (*faces_)(place) : place; }
  std::uint64_t vertex_at(std::uint64_t place) const {
    return vertices_ ? (*vertices_)(place) : place;
  }
  std::uint64_t place_of_vertex(std::uint64_t vertex) const {
    return vertices_ ? vertices_->inverse(vertex) : vertex;
  }

 private:
  std::optional<Permutation> faces_, vertices_;
};

void put_vertices(const Site& site, const SiteOrder& order, TextFile& obj) {
  if (order.shuffles_vertices()) {
    for (std::uint64_t i = 0; i < site.vertices(); ++i) {
      put_vertex(site, site.vertex(order.vertex_at(i)), obj);
    }
  } else if (site.options().duplicate_vertices) {
    put_own_vertices(site, obj);
  } else {
    put_shared_vertices(site, obj);
  }
}

void put_faces(const Site& site, const SiteOrder& order, TextFile& obj) {
  std::optional<std::uint32_t> texture;
  for (std::uint64_t i = 0; i < site.faces(); ++i) {
    SiteFace face = site.face(order.face_at(i));
    for (std::uint64_t& v : face.v) v = order.place_of_vertex(v);
    if (face.texture != texture) {
      obj.put("usemtl m");
      obj.put(std::uint64_t{face.texture});
      obj.put('\n');
      texture = face.texture;
    }
    put_face(face, obj);
  }
}

void write_obj(const Site& site, const std::string& path) {
  const SiteOrder order(site);
  TextFile obj(path);
  obj.put("mtllib " + site.options().name + ".mtl\n");
  put_vertices(site, order, obj);
  put_texcoords(site, obj);
  put_faces(site, order, obj);
  obj.close();
}

void write_mtl(const Site& site, const std::string& path) {
  TextFile mtl(path);
  const std::vector<std::string> names = site.texture_names();
  for (std::size_t texture = 0; texture < names.size(); ++texture) {
    mtl.put(fmt::format("newmtl m{}\nKd 1 1 1\n", texture));
    if (site.options().image_format != ImageFormat::kNone) {
      mtl.put(fmt::format("map_Kd {}\n", names[texture]));
    }
  }
  mtl.close();
}

void write_images(const Site& site, const std::string& directory) {
  if (site.options().image_format == ImageFormat::kNone) return;
  const std::vector<std::string> names = site.texture_names();
  for (std::size_t texture = 0; texture < names.size(); ++texture) {
    const std::uint64_t size = site.options().texture_size_texels;
    write_image(directory + "/" + names[texture], size, waves_and_noise(size, texture));
  }
}

}  // namespace

void write_site(const Site& site, const std::string& directory) {
  const std::string stem = directory + "/" + site.options().name;
  write_answers(site_answers(site), stem + ".answers.json");
  write_mtl(site, stem + ".mtl");
  write_images(site, directory);
  write_obj(site, stem + ".obj");
}

}  // namespace atlasgauge
