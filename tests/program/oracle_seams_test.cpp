// Seams worked by hand, before the oracle is believed.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "tests/support/oracle/oracle.hpp"

namespace atlasgauge {
namespace {

using nlohmann::json;
using oracle::Colour;
using oracle::Model;
using oracle::Pixels;
using oracle::Position;
using oracle::Size;
using oracle::Uv;

constexpr const char* kAverage = "seam_discrepancy_avg";
constexpr const char* kTexMetro = "seam_discrepancy_texmetro_avg";

Colour grey(double value) {
  return {value, value, value};
}

/// Of red alone, so that distances are differences.
Pixels red(std::function<double(std::int64_t column, std::int64_t row)> of) {
  return [of = std::move(of)](std::int64_t column, std::int64_t row) {
    return Colour{of(column, row), 0, 0};
  };
}

Pixels plain(double value) {
  return red([=](std::int64_t, std::int64_t) { return value; });
}

/// Rises by `slope` from column to column.
Pixels ramp(double slope) {
  return red(
      [=](std::int64_t column, std::int64_t) { return slope * static_cast<double>(column); });
}

/// Two vertices of a seam on one image.
using Segment = std::array<Uv, 2>;

/// A quad of two triangles, cut along the diagonal from (0, 0, 0) to (1, 1, 0); each has an image
/// of its own. Both triangles run around it in the same direction.
Model cut_quad(const Size& size, const std::array<Pixels, 2>& images,
               const std::array<Segment, 2>& diagonals) {
  Model model;
  model.with_images = true;
  model.positions = {{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}};
  for (const Pixels& pixels : images) model.slots.push_back({"image", "image", size, pixels});
  const auto off_diagonal = [](const Segment& diagonal) {  // anywhere but on it
    return Uv{diagonal[0][0] + (diagonal[1][1] - diagonal[0][1]) + 0.25F,
              diagonal[0][1] - (diagonal[1][0] - diagonal[0][0])};
  };
  model.faces.push_back(
      {{1, 0, 2}, {diagonals[0][1], diagonals[0][0], off_diagonal(diagonals[0])}, 0});
  model.faces.push_back(
      {{0, 1, 3}, {diagonals[1][0], diagonals[1][1], off_diagonal(diagonals[1])}, 1});
  return model;
}

/// On 8x8 texels: from the middle of the first texel of a row to the middle of the fifth.
constexpr Segment kFourTexels = {{{0.0625F, 0.5625F}, {0.5625F, 0.5625F}}};
constexpr Segment kFourTexelsBack = {kFourTexels[1], kFourTexels[0]};
constexpr Size kSize{8, 8};

const double kDiagonal = std::sqrt(2.0);

TEST(OracleSeamsTest, StepHasItsHeight) {
  const json report =
      oracle::measure(cut_quad(kSize, {plain(50), plain(80)}, {kFourTexels, kFourTexelsBack}));
  for (const char* key : {"_min", "_max", "_avg", "_rms"}) {
    EXPECT_EQ(report.at(std::string("seam_discrepancy") + key), 30.0) << key;
  }
  EXPECT_EQ(report.at("seam_discrepancy_var"), 0.0);
  EXPECT_EQ(report.at("seam_discrepancy_stddev"), 0.0);
  EXPECT_EQ(report.at("seam_edges_unsampled"), 0);
}

TEST(OracleSeamsTest, DistanceIsThatOfAllChannels) {
  const auto colour = [](const Colour& c) { return [=](std::int64_t, std::int64_t) { return c; }; };
  const json report = oracle::measure(
      cut_quad(kSize, {colour({10, 20, 30}), colour({12, 23, 36})}, {kFourTexels, kFourTexels}));
  EXPECT_EQ(report.at(kAverage), 7.0);  // 2, 3, 6
}

TEST(OracleSeamsTest, BlackAgainstWhiteIsTheLargest) {
  const auto all = [](double x) { return [=](std::int64_t, std::int64_t) { return grey(x); }; };
  const json report =
      oracle::measure(cut_quad(kSize, {all(0), all(255)}, {kFourTexels, kFourTexels}));
  EXPECT_DOUBLE_EQ(report.at(kAverage), 255 * std::sqrt(3.0));
}

// 20 samples at x = (i + 1/2) / 5 along the 4 texels.
TEST(OracleSeamsTest, SidesOfOneRampAreTheSame) {
  const json report =
      oracle::measure(cut_quad(kSize, {ramp(10), ramp(10)}, {kFourTexels, kFourTexels}));
  EXPECT_EQ(report.at(kAverage), 0.0);
  EXPECT_EQ(report.at("worst_seams")[0].at("samples"), 20);
}

// |10 x - 10 (4 - x)| = 20 |x - 2| at the 20 samples: distances of 0.1, 0.3 ... 1.9 to either side
// of the middle, on the average 1.
TEST(OracleSeamsTest, MirroredRampIsWorkedByHand) {
  const json report =
      oracle::measure(cut_quad(kSize, {ramp(10), ramp(10)}, {kFourTexels, kFourTexelsBack}));
  EXPECT_NEAR(report.at(kAverage), 20, 1e-12);
}

// One side runs up, the other down: at x = i / 5, i = 0 ... 19, they differ by 20 |x - 2|. The
// distances to the middle are 2, 1.8 ... 0 ... 1.8: twice 0.2 (1 + ... + 9), and 2, of 20.
TEST(OracleSeamsTest, TexMetroHasSidesRunAgainstEachOther) {
  const json report =
      oracle::measure(cut_quad(kSize, {ramp(10), ramp(10)}, {kFourTexels, kFourTexels}), true);
  EXPECT_EQ(report.at(kAverage), 0.0);
  EXPECT_NEAR(report.at(kTexMetro), 20 * (2 * 0.2 * 45 + 2) / 20, 1e-12);
}

/// As cut_quad, but one triangle is turned round.
Model incoherent_quad(const std::array<Pixels, 2>& images) {
  Model model = cut_quad(kSize, images, {kFourTexels, kFourTexels});
  std::swap(model.faces[1].vertices[0], model.faces[1].vertices[1]);
  std::swap(model.faces[1].uvs[0], model.faces[1].uvs[1]);
  return model;
}

TEST(OracleSeamsTest, TexMetroIsRightWhereFacesAreIncoherent) {
  const json report = oracle::measure(incoherent_quad({ramp(10), ramp(10)}), true);
  EXPECT_EQ(report.at(kTexMetro), 0.0);
}

TEST(OracleSeamsTest, TexMetroIsOnlyReportedWhenAskedFor) {
  EXPECT_FALSE(oracle::measure(cut_quad(kSize, {plain(1), plain(2)}, {kFourTexels, kFourTexels}))
                   .contains(kTexMetro));
}

/// What the one seam of a quad, of no length in colour but that of an image, comes to against
/// black.
double against_black(const Pixels& pixels, const Segment& segment, const Size& size = kSize) {
  return oracle::measure(cut_quad(size, {pixels, plain(0)}, {segment, segment})).at(kAverage);
}

TEST(OracleSeamsTest, VIsUp) {
  const Pixels by_row =
      red([](std::int64_t, std::int64_t row) { return static_cast<double>(row); });
  const Segment low = {{{0, 0.0625F}, {0.5F, 0.0625F}}};
  const Segment high = {{{0, 0.9375F}, {0.5F, 0.9375F}}};
  EXPECT_EQ(against_black(by_row, low), 7);
  EXPECT_EQ(against_black(by_row, high), 0);
}

// Centres of texels have the colour of the texel alone: on the border between two it is the mean.
TEST(OracleSeamsTest, CentresOfTexelsAreAtHalfIntegers) {
  const Pixels by_row =
      red([](std::int64_t, std::int64_t row) { return static_cast<double>(row); });
  const Segment between = {{{0, 0.25F}, {0.5F, 0.25F}}};  // rows 5 and 6 from the top
  EXPECT_EQ(against_black(by_row, between), 5.5);
}

// The mean of 10 x: at the middles of twenty steps from 0 to 4 it is that of the whole.
TEST(OracleSeamsTest, SamplesLieInTheMiddleOfTheirSteps) {
  EXPECT_NEAR(against_black(ramp(10), kFourTexels), 20, 1e-12);
}

// At the beginnings of the steps, from 0 on by the second face, from 4 on by the first.
TEST(OracleSeamsTest, TexMetroSamplesTheBeginningsOfSteps) {
  const auto average = [](const std::array<Pixels, 2>& images) {
    return oracle::measure(cut_quad(kSize, images, {kFourTexels, kFourTexels}), true).at(kTexMetro);
  };
  EXPECT_NEAR(average({plain(0), ramp(10)}), 19, 1e-12);
  EXPECT_NEAR(average({ramp(10), plain(0)}), 21, 1e-12);
}

// The left border is half of the first column and half of the last.
TEST(OracleSeamsTest, LookupAtTheBorderIsHalfOfTheOtherSide) {
  const Pixels first_column =
      red([](std::int64_t column, std::int64_t) { return column == 0 ? 100.0 : 0.0; });
  for (const float u : {0.0F, 1.0F}) {
    EXPECT_EQ(against_black(first_column, {{{u, 0}, {u, 0.5F}}}), 50) << u;
  }
}

TEST(OracleSeamsTest, LookupAtTheBottomIsHalfOfTheTop) {
  const Pixels top = red([](std::int64_t, std::int64_t row) { return row == 0 ? 100.0 : 0.0; });
  for (const float v : {0.0F, 1.0F}) {
    EXPECT_EQ(against_black(top, {{{0, v}, {0.5F, v}}}), 50) << v;
  }
}

// Faces of another chart keep the centre of the UVs inside, so that nothing is shifted.
Model far_segment(const Pixels& pixels, float periods) {
  Segment moved = kFourTexels;
  for (Uv& uv : moved) uv = {uv[0] + periods, uv[1] - periods};
  Model model = cut_quad(kSize, {pixels, plain(0)}, {moved, kFourTexels});
  model.positions.insert(model.positions.end(), {{5, 0, 0}, {6, 0, 0}, {5, 1, 0}});
  const Uv opposite = {-periods, periods};
  model.faces.push_back(
      {{4, 5, 6}, {opposite, Uv{1 - periods, periods}, Uv{-periods, 1 + periods}}, 0});
  return model;
}

TEST(OracleSeamsTest, LookupsRepeatForAnyNumberOfPeriods) {
  const Pixels noise = red([](std::int64_t column, std::int64_t row) {
    return static_cast<double>((column * 31 + row * 57) % 101);
  });
  const double once = against_black(noise, kFourTexels);
  EXPECT_GT(once, 0);
  for (const float periods : {1.0F, -1.0F, 3.0F, -7.0F}) {
    EXPECT_NEAR(oracle::measure(far_segment(noise, periods)).at(kAverage), once, 1e-12) << periods;
  }
}

std::int64_t samples_for(const std::array<Segment, 2>& sides, const Size& size = kSize) {
  const json report = oracle::measure(cut_quad(size, {plain(1), plain(0)}, sides));
  return report.at("worst_seams").at(0).at("samples");
}

Segment of_texels(float texels) {
  return {{{0, 0}, {texels / 8, 0}}};
}

TEST(OracleSeamsTest, TheLongerSideSaysHowManySamples) {
  EXPECT_EQ(samples_for({of_texels(2), of_texels(5)}), 25);
  EXPECT_EQ(samples_for({of_texels(5), of_texels(2)}), 25);
  EXPECT_EQ(samples_for({of_texels(5.5F), of_texels(1)}), 30);
}

TEST(OracleSeamsTest, AMillionthOfATexelIsNoTexel) {
  const float bit_more = std::nextafter(1.0F, 2.0F);
  EXPECT_EQ(samples_for({of_texels(bit_more), of_texels(1)}), 5);
  EXPECT_EQ(samples_for({of_texels(1.00001F), of_texels(1)}), 10);
}

TEST(OracleSeamsTest, TexMetroTakesNoMillionthOff) {
  const Segment segment = of_texels(std::nextafter(1.0F, 2.0F));
  // 0, 0.1 ... 0.9 of one texel against 1, 0.9 ... 0.1 of it, ten samples: not five.
  const json report =
      oracle::measure(cut_quad(kSize, {ramp(10), ramp(10)}, {segment, segment}), true);
  Model model = cut_quad(kSize, {ramp(10), ramp(10)}, {of_texels(1), of_texels(1)});
  const json of_five = oracle::measure(model, true);
  EXPECT_GT(std::abs(report.at(kTexMetro).get<double>() - of_five.at(kTexMetro).get<double>()),
            0.01);
}

/// Both sides of the seam are points, of different UVs.
Model points_quad() {
  return cut_quad(kSize, {plain(10), plain(20)}, {of_texels(0), of_texels(0)});
}

TEST(OracleSeamsTest, EdgeWithoutSamplesIsSkippedAndNotUnsampled) {
  Model model = points_quad();
  model.faces[0].uvs[2] = Uv{0.5F, 0.5F};
  // A chart has to have an area: another face of it has one.
  model.positions.push_back({2, 0.5, 0});
  model.faces.push_back({{1, 2, 4}, {model.faces[0].uvs[0], model.faces[0].uvs[2], Uv{1, 0}}, 0});
  model.positions.push_back({-1, 0.5, 0});
  model.faces.push_back(
      {{0, 3, 5}, {model.faces[1].uvs[0], model.faces[1].uvs[2], Uv{1, 0.5F}}, 1});
  const json report = oracle::measure(model, true);
  EXPECT_EQ(report.at("seam_edges"), 1);
  EXPECT_EQ(report.at("seam_edges_unsampled"), 0);
  EXPECT_EQ(report.at(kAverage), nullptr);
  EXPECT_EQ(report.at(kTexMetro), nullptr);
  EXPECT_EQ(report.at("worst_seams"), json::array());
  EXPECT_EQ(report.at("seam_discrepancy_by_texture"), json::array({nullptr, nullptr}));
}

TEST(OracleSeamsTest, SeamOnAnImageThatCannotBeDecodedIsUnsampled) {
  const json report =
      oracle::measure(cut_quad(kSize, {plain(1), {}}, {kFourTexels, kFourTexels}), true);
  EXPECT_EQ(report.at("seam_edges"), 1);
  EXPECT_EQ(report.at("seam_edges_unsampled"), 1);
  EXPECT_EQ(report.at(kAverage), nullptr);
  EXPECT_EQ(report.at(kTexMetro), nullptr);
}

TEST(OracleSeamsTest, SeamOfAFaceFarOutIsUnsampled) {
  Model model = cut_quad(kSize, {plain(1), plain(2)}, {kFourTexels, kFourTexels});
  model.faces[0].uvs[2] = Uv{0x1p28F, 0};
  EXPECT_EQ(oracle::measure(model).at("seam_edges_unsampled"), 1);
}

/// The quad in one chart.
Model whole_quad(bool with_images) {
  Model model = cut_quad(kSize, {plain(1), plain(2)}, {kFourTexels, kFourTexels});
  model.with_images = with_images;
  model.faces[1].slot = 0;
  return model;
}

TEST(OracleSeamsTest, WithoutSeamsItIsZeroIfThereAreImages) {
  const json with = oracle::measure(whole_quad(true), true);
  const json without = oracle::measure(whole_quad(false), true);
  EXPECT_EQ(with.at("seam_edges"), 0);
  for (const char* key : {"_min", "_max", "_avg", "_rms", "_var", "_stddev", "_texmetro_avg"}) {
    EXPECT_EQ(with.at(std::string("seam_discrepancy") + key), 0.0) << key;
    EXPECT_EQ(without.at(std::string("seam_discrepancy") + key), nullptr) << key;
  }
  EXPECT_EQ(with.at("seam_discrepancy_by_texture"), json::array({nullptr, nullptr}));
}

/// Strips of one triangle and its neighbour, cut along the edge between them: of that 3D length,
/// and with that step from slot to slot.
struct Strip {
  double length;
  std::array<std::int64_t, 2> slots;
};

Model strips(const std::vector<double>& reds, const std::vector<Strip>& strips) {
  Model model;
  model.with_images = true;
  for (const double value : reds) model.slots.push_back({"", "", kSize, plain(value)});
  for (const Strip& strip : strips) {
    const auto v = static_cast<std::int64_t>(model.positions.size());
    const double y = static_cast<double>(v);
    model.positions.insert(model.positions.end(),
                           {{0, y, 0}, {strip.length, y, 0}, {0, y - 1, 0}, {0, y + 1, 0}});
    const Uv p = {0, 0}, q = {0.5F, 0}, up = {0, 0.5F};
    const Uv p2 = {0.5F, 0.5F}, q2 = {1, 0.5F}, up2 = {0.5F, 1};
    model.faces.push_back({{v + 1, v, v + 2}, {q, p, up}, strip.slots[0]});
    model.faces.push_back({{v, v + 1, v + 3}, {p2, q2, up2}, strip.slots[1]});
  }
  return model;
}

// Steps of 10 and 40 on lengths of 3 and 1.
TEST(OracleSeamsTest, EdgesCountByTheirLengthInSpace) {
  const json report = oracle::measure(strips({0, 10, 40}, {{3, {0, 1}}, {1, {0, 2}}}));
  EXPECT_EQ(report.at("seam_discrepancy_min"), 10.0);
  EXPECT_EQ(report.at("seam_discrepancy_max"), 40.0);
  EXPECT_EQ(report.at(kAverage), 70.0 / 4);
  EXPECT_EQ(report.at("seam_discrepancy_var"), 3 * 7.5 * 7.5 / 4 + 22.5 * 22.5 / 4);
  EXPECT_DOUBLE_EQ(report.at("seam_discrepancy_rms"), std::sqrt((300.0 + 1600) / 4));
}

// The third image meets itself only, the fourth nothing.
TEST(OracleSeamsTest, TexturesHaveTheMeanOfTheSeamsOnThem) {
  const json report =
      oracle::measure(strips({0, 10, 40, 90}, {{3, {0, 1}}, {1, {0, 2}}, {5, {2, 2}}}));
  EXPECT_EQ(report.at("seam_discrepancy_by_texture"),
            json::array({70.0 / 4, 10.0, 40.0 / 6, nullptr}));
}

TEST(OracleSeamsTest, WorstSeamsComeByHeightThenLengthThenVertices) {
  const json report = oracle::measure(
      strips({0, 10, 40}, {{3, {0, 1}}, {1, {0, 2}}, {2, {2, 0}}, {1, {0, 2}}, {9, {1, 1}}}));
  json order = json::array();
  for (const json& seam : report.at("worst_seams")) {
    order.push_back({seam.at("discrepancy"), seam.at("length_3d"), seam.at("from").at(1)});
  }
  EXPECT_EQ(order, json::parse("[[40, 2, 8], [40, 1, 4], [40, 1, 12], [10, 3, 0], [0, 9, 16]]"));
}

TEST(OracleSeamsTest, TwentyWorstSeamsAreListed) {
  std::vector<Strip> many(25, {1, {0, 1}});
  many.push_back({1, {0, 2}});
  const json worst = oracle::measure(strips({0, 10, 40}, many)).at("worst_seams");
  ASSERT_EQ(worst.size(), 20);
  EXPECT_EQ(worst.front().at("discrepancy"), 40.0);
  EXPECT_EQ(worst.back().at("from"), json({0, 18 * 4, 0}));
}

TEST(OracleSeamsTest, AWorstSeamSaysWhereItIs) {
  const json report = oracle::measure(strips({0, 10}, {{3, {1, 0}}}));
  EXPECT_EQ(report.at("worst_seams"), json::parse(R"([{
      "discrepancy": 10, "length_3d": 3, "samples": 20, "from": [0, 0, 0], "to": [3, 0, 0],
      "sides": [{"texture": 0, "uv_from": [0.5, 0.5], "uv_to": [1, 0.5]},
                {"texture": 1, "uv_from": [0, 0], "uv_to": [0.5, 0]}]}])"));
}

// v decides before u.
TEST(OracleSeamsTest, SidesOnOneTextureAreOrderedByTheBitsOfTheirUvs) {
  Model model = strips({0}, {{3, {0, 0}}});
  model.faces[0].uvs = {Uv{1, 0.25F}, Uv{0.75F, 0.25F}, Uv{1, 1}};
  const json sides = oracle::measure(model).at("worst_seams").at(0).at("sides");
  EXPECT_EQ(sides.at(0).at("uv_from"), json({0.75, 0.25}));
  EXPECT_EQ(sides.at(1).at("uv_from"), json({0.5, 0.5}));
}

// Duplicates of vertices along the cut: the seam is that of the first ones.
TEST(OracleSeamsTest, VerticesOfASeamAreWelded) {
  Model model = cut_quad(kSize, {plain(5), plain(9)}, {kFourTexels, kFourTexels});
  model.positions.insert(model.positions.end(), {{1, 1, 0}, {-0.0, 0, 0}});
  model.faces[1].vertices = {5, 4, 3};
  const json report = oracle::measure(model);
  EXPECT_EQ(report.at("seam_edges"), 1);
  EXPECT_EQ(report.at(kAverage), 4.0);
  EXPECT_EQ(report.at("seam_len"), kDiagonal);
  EXPECT_EQ(report.at("worst_seams").at(0).at("from"), json({0, 0, 0}));
}

// Shifting a texture's UVs by whole numbers moves no colour, but worst_seams has them as in the
// file.
TEST(OracleSeamsTest, UvsAreThoseOfTheFileBeforeAnyShift) {
  const Pixels noise = red([](std::int64_t column, std::int64_t row) {
    return static_cast<double>((column * 31 + row * 57) % 101);
  });
  Segment moved = kFourTexels;
  for (Uv& uv : moved) uv = {uv[0] + 4, uv[1] - 9};
  const json report = oracle::measure(cut_quad(kSize, {noise, plain(0)}, {moved, kFourTexels}));
  EXPECT_NEAR(report.at(kAverage), against_black(noise, kFourTexels), 1e-12);
  EXPECT_EQ(report.at("worst_seams").at(0).at("sides").at(0).at("uv_from"), json(moved[0]));
}

}  // namespace
}  // namespace atlasgauge
