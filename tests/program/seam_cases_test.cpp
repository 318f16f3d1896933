// Seams whose discrepancy is known beforehand, as files: each case goes through everything that
// measures seams.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/computed_images.hpp"
#include "tests/support/oracle_comparison.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using nlohmann::json;

using Colour = std::array<double, 3>;
using Point = std::array<double, 2>;

/// On a surface in the plane, or on an image in texels with v up.
using ColourAt = std::function<Colour(const Point&)>;

/// Lays a part of the plane on an image: turned about a centre, mirrored, scaled.
struct Placement {
  Point centre;        ///< on the surface
  double texels = 1;   ///< a unit of the surface
  double degrees = 0;  ///< on the image, against the clock
  bool mirrored = false;
  ImageSize image = {64, 64};

  Point direction() const {
    const double angle = degrees * (std::numbers::pi / 180);
    return {std::cos(angle), std::sin(angle)};
  }

  Point to_texels(const Point& p) const {
    const auto [cosine, sine] = direction();
    const double x = (mirrored ? -1 : 1) * (p[0] - centre[0]) * texels;
    const double y = (p[1] - centre[1]) * texels;
    return {cosine * x - sine * y + image.width / 2.0, sine * x + cosine * y + image.height / 2.0};
  }

  Point to_surface(const Point& t) const {
    const auto [cosine, sine] = direction();
    const double x = t[0] - image.width / 2.0, y = t[1] - image.height / 2.0;
    const double along = (cosine * x + sine * y) / texels, up = (cosine * y - sine * x) / texels;
    return {centre[0] + (mirrored ? -along : along), centre[1] + up};
  }
};

/// A surface in the plane, of charts that each have an image of their own.
class PlaneModel {
 public:
  /// Quads of the chart follow.
  void begin_chart(const Placement& placement, TexelKind kind, const ColourAt& on_surface) {
    placement_ = placement;
    const std::string name = "chart" + std::to_string(images_.size());
    mtl_ += "newmtl " + name + "\nmap_Kd " + name + ".png\n";
    obj_ += "usemtl " + name + "\n";
    images_[name + ".png"] = {.size = placement.image,
                              .kind = kind,
                              .colour = [=](std::uint32_t column, std::uint32_t row) {
                                const double y = placement.image.height - 1.0 - row;
                                return on_surface(placement.to_surface({column + 0.5, y + 0.5}));
                              }};
  }

  void add_quad(const Point& low, const Point& high) {
    for (const Point& p : {low, Point{high[0], low[1]}, high, Point{low[0], high[1]}}) {
      const Point t = placement_.to_texels(p);
      obj_ += "v " + json(p[0]).dump() + " " + json(p[1]).dump() + " 0\n";
      obj_ += "vt " + json(t[0] / placement_.image.width).dump() + " " +
              json(t[1] / placement_.image.height).dump() + "\n";
    }
    obj_ += "f -4/-4 -3/-3 -2/-2 -1/-1\n";
  }

  void break_last_image() { images_.rbegin()->second.broken_row = 40; }

  using Measure = Outcome (*)(const std::string& model, const PipelineConfig& config);

  json report(Measure measure) const {
    const TempDir dir;
    dir.write("model.mtl", mtl_);
    for (const auto& image : images_) dir.write(image.first, "");
    const ComputedImages images(images_);
    PipelineConfig config;
    config.probe = images.probe();
    config.open_image = images.open();
    config.texmetro_seams = true;
    return measure(dir.write("model.obj", "mtllib model.mtl\n" + obj_), config).report.value();
  }

 private:
  Placement placement_{};
  std::string obj_;
  std::string mtl_;
  std::map<std::string, ComputedImage> images_;
};

class SeamCaseTest : public testing::TestWithParam<PlaneModel::Measure> {
 protected:
  static double average(const PlaneModel& model) {
    return model.report(GetParam()).at("seam_discrepancy_avg");
  }
};

INSTANTIATE_TEST_SUITE_P(Oracle, SeamCaseTest, testing::Values(oracle_outcome));

/// Rises by 20, 8 and 5 a unit of length, over some texels.
Colour linear(const Point& p) {
  return {100 + 20 * p[0] + 4 * p[1], 120 - 8 * p[1], 90 + 5 * p[0] - 3 * p[1]};
}

/// Four unit quads around a point, that of the last chart in colours of its own.
PlaneModel four_quads(const ColourAt& of_last) {
  PlaneModel model;
  const std::array<Placement, 4> placements = {
      Placement{.centre = {0.5, 0.5}, .texels = 20, .degrees = 0},
      Placement{.centre = {1.5, 0.5}, .texels = 13.7, .degrees = 33},
      Placement{.centre = {0.5, 1.5}, .texels = 31, .degrees = 180, .mirrored = true},
      Placement{.centre = {1.5, 1.5},
                .texels = 17.1,
                .degrees = -101,
                .mirrored = true,
                .image = {47, 90}},
  };
  for (std::size_t i = 0; i < placements.size(); ++i) {
    model.begin_chart(placements[i], TexelKind::kFloat, i == 3 ? of_last : linear);
    const Point low = {placements[i].centre[0] - 0.5, placements[i].centre[1] - 0.5};
    model.add_quad(low, {low[0] + 1, low[1] + 1});
  }
  return model;
}

// Bilinear lookups have no error in a linear function: what is left is that of float UVs, some
// 64 * 2^-24 texels, and of float colours.
constexpr double kFloatError = 1e-4;

TEST_P(SeamCaseTest, LinearFunctionOfTheSurfaceHasNoSeams) {
  const json report = four_quads(linear).report(GetParam());
  EXPECT_EQ(report.at("seam_edges"), 4);
  EXPECT_EQ(report.at("seam_edges_unsampled"), 0);
  EXPECT_LT(report.at("seam_discrepancy_max"), kFloatError);
}

TEST_P(SeamCaseTest, TexMetroSeesSeamsInALinearFunction) {
  EXPECT_GT(four_quads(linear).report(GetParam()).at("seam_discrepancy_texmetro_avg"), 1);
}

// 2, 3 and 6, on two of four seams.
TEST_P(SeamCaseTest, StepOnALinearFunctionHasItsHeight) {
  const json report = four_quads([](const Point& p) {
                        const Colour c = linear(p);
                        return Colour{c[0] + 2, c[1] + 3, c[2] - 6};
                      }).report(GetParam());
  EXPECT_NEAR(report.at("seam_discrepancy_max"), 7, kFloatError);
  EXPECT_NEAR(report.at("seam_discrepancy_avg"), 3.5, kFloatError);
  EXPECT_NEAR(report.at("seam_discrepancy_by_texture")[3], 7, kFloatError);
  EXPECT_NEAR(report.at("seam_discrepancy_by_texture")[0], 0, kFloatError);
}

/// A unit quad within four that surround it, all of one colour but for the one to the left.
PlaneModel cross(TexelKind kind, const Colour& of_left) {
  const Colour grey = {100, 100, 100};
  const std::array<Point, 5> lows = {Point{1, 1}, {0, 1}, {2, 1}, {1, 0}, {1, 2}};
  PlaneModel model;
  for (std::size_t i = 0; i < lows.size(); ++i) {
    const auto [x, y] = lows[i];
    model.begin_chart({.centre = {x, y}, .texels = 11}, kind,
                      [=](const Point&) { return i == 1 ? of_left : grey; });
    model.add_quad(lows[i], {x + 1, y + 1});
  }
  return model;
}

TEST_P(SeamCaseTest, StepAlongOneSideHasExactlyItsHeight) {
  for (const TexelKind kind : {TexelKind::kByte, TexelKind::kShort}) {
    const json report = cross(kind, {112, 116, 121}).report(GetParam());
    EXPECT_EQ(report.at("seam_edges"), 4);
    EXPECT_NEAR(report.at("seam_discrepancy_max"), 29, 1e-12);  // 12, 16, 21
    EXPECT_NEAR(report.at("seam_discrepancy_avg"), 29 / 4.0, 1e-12);
    EXPECT_EQ(report.at("seam_discrepancy_min"), 0.0);
  }
}

/// Two strips of one unit with colours of their own, cut into so many quads along the seam between
/// them.
PlaneModel strips(int quads) {
  PlaneModel model;
  const auto add = [&](const Placement& placement, double low, const ColourAt& colour) {
    model.begin_chart(placement, TexelKind::kFloat, colour);
    for (int i = 0; i < quads; ++i) {
      model.add_quad({i / double(quads), low}, {(i + 1) / double(quads), low + 0.25});
    }
  };
  add({.centre = {0.5, 0.125}, .texels = 40}, 0, [](const Point& p) {
    return Colour{128 + 100 * std::sin(4 * p[0] + p[1]), 0, 0};
  });
  add({.centre = {0.5, 0.375}, .texels = 23, .degrees = 130, .mirrored = true}, 0.25,
      [](const Point& p) {
        return Colour{100 + 90 * std::cos(3 * p[0] - p[1]), 0, 0};
      });
  return model;
}

// The difference along the seam changes by at most 400 + 270 a unit, the samples are at most a
// 200th of it apart. A sample stands for the mean up to a quarter of the change from one to the
// next.
TEST_P(SeamCaseTest, SubdivisionAlongTheSeamChangesLessThanTheSamplesErr) {
  constexpr double kError = (400.0 + 270.0) / 200 / 4;
  const double whole = average(strips(1));
  EXPECT_GT(whole, 40);
  for (const int quads : {2, 3, 7, 16, 64}) {
    const PlaneModel model = strips(quads);
    EXPECT_EQ(model.report(GetParam()).at("seam_edges"), quads);
    EXPECT_NEAR(average(model), whole, kError) << quads;
  }
}

TEST_P(SeamCaseTest, SeamOfAnImageThatBreaksOffIsUnsampled) {
  PlaneModel model = strips(3);
  model.break_last_image();
  const json report = model.report(GetParam());
  EXPECT_EQ(report.at("seam_edges_unsampled"), 3);
  EXPECT_EQ(report.at("seam_discrepancy_avg"), nullptr);
}

}  // namespace
}  // namespace atlasgauge
