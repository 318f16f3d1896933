#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/answers.hpp"

namespace atlasgauge {

enum class ImageFormat { kNone, kPng, kJpg };

/// What site to make. Equal options give equal bytes.
struct SiteOptions {
  std::string name = "site";
  std::uint64_t faces = 1'000'000;  ///< wished for; Site::faces() is the number made
  std::uint32_t textures = 1;       ///< 1 without images: such a model has a single slot
  /// A power of two, so that texel coordinates are exact as floats in [0, 1].
  std::uint32_t texture_size_texels = 1024;
  /// Without images no material names one: to be measured with -t SIZExSIZE.
  ImageFormat image_format = ImageFormat::kPng;
  std::uint32_t chart_side_min_quads = 7;
  std::uint32_t chart_side_max_quads = 60;  ///< at least twice the minimum
  std::optional<std::uint64_t> shuffle_seed;
  std::optional<std::uint64_t> vertex_shuffle_seed;
  bool duplicate_vertices = false;  ///< every chart has vertices of its own: seams need a weld
  int decimals = 6;                 ///< of positions; 6 are exact, more are zeros
};

/// One direction of the site: a line of quads, cut into charts, the charts shared out to textures.
/// Holds a few numbers per chart of the line, so a site holds about sqrt(faces) / 50 of them.
class SiteAxis {
 public:
  SiteAxis(std::uint64_t quads_per_texture, std::uint32_t textures, const SiteOptions& options,
           std::uint64_t seed);

  /// Lays the charts out for `scale` 64ths of a texel a quad; returns the texels that the fullest
  /// texture needs.
  std::uint64_t place(std::uint64_t scale);

  std::uint64_t quads() const { return begins_.back(); }
  std::size_t charts() const { return begins_.size() - 1; }
  std::uint64_t begin(std::size_t chart) const { return begins_[chart]; }
  std::uint64_t length(std::size_t chart) const { return begins_[chart + 1] - begins_[chart]; }
  std::size_t chart_of(std::uint64_t quad) const;
  std::uint32_t texture(std::size_t chart) const { return textures_[chart]; }
  std::uint64_t begin_texels(std::size_t chart) const { return begins_texels_[chart]; }
  /// Roofs stand where two roof lines cross: never at the border, never beside each other.
  bool roof_line(std::size_t chart) const { return chart % 4 == 1 && chart + 1 < charts(); }
  /// Sum of length + 1 over the roof lines before `chart`.
  std::uint64_t roof_points_before(std::size_t chart) const { return roof_points_[chart]; }

 private:
  void cut(std::uint64_t quads, const SiteOptions& options, std::uint64_t seed);

  std::vector<std::uint64_t> begins_{0};
  std::vector<std::uint64_t> begins_texels_;
  std::vector<std::uint64_t> roof_points_{0};
  std::vector<std::uint32_t> textures_;
};

/// A rectangle of quads of the site and its rectangle of texels.
struct SiteChart {
  std::uint64_t x, y;           ///< first quad
  std::uint64_t width, height;  ///< in quads
  std::uint32_t texture;
  std::size_t scale_class;       ///< see Site::quad_texels
  std::uint64_t u, v;            ///< lower left corner, in kTexelUnits
  std::uint64_t u_step, v_step;  ///< of a quad, in kTexelUnits
  bool mirrored;                 ///< u runs backwards, so the chart's UV area is negative
  bool roof;                     ///< lifted off the ground: a component of its own above a hole
};

/// Indices from 0.
struct SiteFace {
  std::array<std::uint64_t, 3> v;
  std::array<std::uint64_t, 3> t;
  std::uint32_t texture;
};

/// A vertex by its place: a point of the ground's lattice, perhaps lifted.
struct SiteVertex {
  std::uint64_t x, y;  ///< in quads
  std::int64_t lift;   ///< in length units
};

/// A textured site whose every element is a function of its index.
///
/// The ground is a lattice of nx × ny quads of two triangles, a profile of level strips and ramps
/// extruded along y. With 1/64 as unit of length a quad measures 4 along y and 4 (level) or 5
/// (ramp: 4 ahead, 3 up or down) along the profile, so every length and area is dyadic. It is cut
/// into charts, rectangles of quads; some are lifted to roofs, and the vertices that lay inside
/// such a chart stay behind, unreferenced. Textures are the cells of a coarser grid. A chart is
/// projected from above: a quad becomes a rectangle of texels whose size is one of a few dyadic
/// scales.
class Site {
 public:
  static constexpr std::uint64_t kTexelUnits = 128;  ///< in a texel
  static constexpr std::size_t kScaleClasses = 4;
  static constexpr std::int64_t kLengthUnits = 64;  ///< in a model unit
  static constexpr std::uint64_t kStep = 4;         ///< length of a level quad's sides
  static constexpr std::uint64_t kRampLength = 5;   ///< hypotenuse of kStep ahead and 3 up

  /// Throws Error(kUsage) when the options make no site.
  explicit Site(const SiteOptions& options);

  const SiteOptions& options() const { return options_; }
  const SiteAxis& columns() const { return columns_; }
  const SiteAxis& rows() const { return rows_; }

  std::uint64_t faces() const { return 2 * columns_.quads() * rows_.quads(); }
  std::uint64_t vertices() const;
  std::uint64_t texcoords() const;
  std::uint64_t charts() const { return columns_.charts() * rows_.charts(); }

  SiteChart chart(std::size_t column, std::size_t row) const;
  /// Faces run chart by chart, charts row by row. Not shuffled.
  SiteFace face(std::uint64_t index) const;
  /// Not shuffled.
  SiteVertex vertex(std::uint64_t index) const;

  /// Texels of a quad's sides in a scale class, in kTexelUnits.
  std::array<std::uint64_t, 2> quad_texels(std::size_t scale_class) const;
  /// Height of the ground at lattice column `x`, in length units.
  static std::int64_t height(std::uint64_t x);
  static std::int64_t roof_height() { return 2 * kLengthUnits; }
  /// Ramps among the columns of quads before `x`.
  static std::uint64_t ramps_before(std::uint64_t x);

  /// Names of the images beside the OBJ, or "N/A" without images.
  std::vector<std::string> texture_names() const;

 private:
  std::uint32_t texture(std::size_t column, std::size_t row) const;
  std::uint64_t ground_vertices() const { return (columns_.quads() + 1) * (rows_.quads() + 1); }
  std::uint64_t texcoord_index(std::size_t column, std::size_t row, std::uint64_t i,
                               std::uint64_t j) const;
  std::uint64_t vertex_index(std::size_t column, std::size_t row, std::uint64_t i,
                             std::uint64_t j) const;
  std::uint64_t ground_index(std::size_t column, std::size_t row, std::uint64_t i,
                             std::uint64_t j) const;
  std::uint64_t roof_index(std::size_t column, std::size_t row, std::uint64_t i,
                           std::uint64_t j) const;

  SiteVertex own_vertex(std::uint64_t index) const;
  SiteVertex ground_vertex(std::uint64_t index) const;
  SiteVertex roof_vertex(std::uint64_t index) const;

  SiteOptions options_;
  SiteAxis columns_;
  SiteAxis rows_;
  std::uint64_t scale_;  ///< 64ths of a texel a quad at full scale
};

Answers site_answers(const Site& site);

/// Writes NAME.obj, NAME.mtl, the images and NAME.answers.json into a directory. Needs a few
/// megabytes, whatever the size of the site.
void write_site(const Site& site, const std::string& directory);

}  // namespace atlasgauge
