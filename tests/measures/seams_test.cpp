// Seams by themselves, on edges with hand-worked numbers.

#include <gtest/gtest.h>

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "measures/base/measure.hpp"
#include "tests/measures/random_groups.hpp"

namespace atlasgauge {
namespace {

using Seams = std::vector<SeamEdge>;

Report report_of(const std::string& name, const Seams& edges,
                 const MeshFacts& facts = any_facts()) {
  Report report;
  for (const auto& measure : all_measures()) {
    if (measure->name() != name) continue;
    measure->accept(std::span(edges));
    measure->finish(facts, report);
  }
  return report;
}

SeamEdge unsampled(double length_3d) {
  SeamEdge edge;
  edge.length_3d = length_3d;
  return edge;
}

SeamEdge too_short(double length_3d) {
  SeamEdge edge = unsampled(length_3d);
  edge.sampled = true;
  return edge;
}

SeamEdge measured(double length_3d, double discrepancy) {
  SeamEdge edge = too_short(length_3d);
  edge.samples = 5;
  edge.discrepancy = discrepancy;
  edge.texmetro_discrepancy = discrepancy + 10;
  edge.sides[0] = {SlotId{0}, {{0.1F, 0.25F}, {0.5F, 1}}};
  edge.sides[1] = {SlotId{1}, {{0, 0}, {1, 1}}};
  return edge;
}

SeamEdge between(std::uint32_t v0, std::uint32_t v1, SeamEdge edge) {
  edge.v[0] = VertexId{v0};
  edge.v[1] = VertexId{v1};
  return edge;
}

TEST(SeamsMeasureTest, CountsAndAddsLengths) {
  const Report report = report_of("seams", {too_short(0.5), unsampled(2), measured(1, 7)});
  EXPECT_EQ(report.at("seam_edges"), 3);
  EXPECT_EQ(report.at("seam_len"), 3.5);
  EXPECT_EQ(report.at("seam_edges_unsampled"), 1);
}

// Over length 4: mean (3 * 8 + 1 * 16) / 4, mean square (3 * 64 + 256) / 4.
TEST(SeamsMeasureTest, DiscrepancyIsWeightedByLengthIn3d) {
  const Report report =
      report_of("seams", {measured(3, 8), measured(1, 16), unsampled(100), too_short(100)});
  EXPECT_EQ(report.at("seam_discrepancy_min"), 8);
  EXPECT_EQ(report.at("seam_discrepancy_max"), 16);
  EXPECT_EQ(report.at("seam_discrepancy_avg"), 10);
  EXPECT_DOUBLE_EQ(report.at("seam_discrepancy_rms").get<double>(), std::sqrt(112));
  EXPECT_EQ(report.at("seam_discrepancy_var"), 12);
  EXPECT_DOUBLE_EQ(report.at("seam_discrepancy_stddev").get<double>(), std::sqrt(12));
}

TEST(SeamsMeasureTest, TexmetroIsAMeanOfItsOwnOverTheSameEdges) {
  const Report report = report_of("seams", {measured(3, 8), measured(1, 16), unsampled(100)});
  EXPECT_EQ(report.at("seam_discrepancy_texmetro_avg"), 20);
}

TEST(SeamsMeasureTest, TexmetroIsThereOnlyIfAskedFor) {
  MeshFacts facts = any_facts();
  facts.texmetro_seams = false;
  SeamEdge edge = measured(1, 5);
  edge.texmetro_discrepancy = std::numeric_limits<double>::quiet_NaN();
  const Report report = report_of("seams", {edge}, facts);
  EXPECT_FALSE(report.to_json().contains("seam_discrepancy_texmetro_avg"));
  EXPECT_EQ(report.at("seam_discrepancy_avg"), 5);
}

const std::vector<std::string> kMoments{"seam_discrepancy_min",         "seam_discrepancy_max",
                                        "seam_discrepancy_avg",         "seam_discrepancy_rms",
                                        "seam_discrepancy_var",         "seam_discrepancy_stddev",
                                        "seam_discrepancy_texmetro_avg"};

TEST(SeamsMeasureTest, ImagesWithoutSeamsHaveZero) {
  const Report report = report_of("seams", {});
  for (const std::string& key : kMoments) EXPECT_EQ(report.at(key), 0) << key;
}

TEST(SeamsMeasureTest, WithoutImagesThereIsNothing) {
  MeshFacts facts = any_facts();
  facts.textures.has_images = false;
  for (const Seams& edges : {Seams{}, Seams{unsampled(1)}}) {
    const Report report = report_of("seams", edges, facts);
    for (const std::string& key : kMoments) EXPECT_TRUE(report.at(key).is_null()) << key;
  }
}

TEST(SeamsMeasureTest, SeamsOfWhichNoneWasSampledAreNull) {
  const Report report = report_of("seams", {unsampled(1), too_short(1)});
  for (const std::string& key : kMoments) EXPECT_TRUE(report.at(key).is_null()) << key;
}

TEST(SeamsMeasureTest, EveryTextureHasItsNumberOrNull) {
  MeshFacts facts = any_facts();
  facts.textures.slots.resize(5);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  facts.texture_seams = spill_for_facts<TextureSeams>(
      {{SlotId{1}, 3, 4.5, 2.25}, {SlotId{2}, 1, 0, nan}, {SlotId{3}, 1, 1, 0}});
  EXPECT_EQ(report_of("seams", {}, facts).at("seam_discrepancy_by_texture"),
            Json::array({nullptr, 2.25, nullptr, 0, nullptr}));
}

TEST(SeamsMeasureTest, TexturesWithoutSeamsAreAllNull) {
  EXPECT_EQ(report_of("seams", {}).at("seam_discrepancy_by_texture"), Json::array({nullptr}));
}

TEST(WorstSeamsTest, SayWhereTheyAre) {
  const Report report = report_of("worst_seams", {between(2, 4, measured(0.5, 441))});
  EXPECT_EQ(report.at("worst_seams"), Json::parse(R"([{
      "discrepancy": 441.0, "length_3d": 0.5, "samples": 5,
      "from": [2.0, 1.0, -2.0], "to": [4.0, 2.0, -4.0],
      "sides": [{"texture": 0, "uv_from": [0.1, 0.25], "uv_to": [0.5, 1.0]},
                {"texture": 1, "uv_from": [0.0, 0.0], "uv_to": [1.0, 1.0]}]}])"));
}

TEST(WorstSeamsTest, PositionsAreFoundInAnyBlock) {
  const std::uint32_t last = RandomGroups::kVertices - 1;
  const Json list =
      report_of("worst_seams", {between(0, last, measured(1, 2)), between(1, 2, measured(1, 1))})
          .at("worst_seams");
  EXPECT_EQ(list[0]["from"][0], 0);
  EXPECT_EQ(list[0]["to"][0], last);
  EXPECT_EQ(list[1]["from"][0], 1);
}

TEST(WorstSeamsTest, EdgesWithoutSamplesAreNotAmongThem) {
  EXPECT_EQ(report_of("worst_seams", {unsampled(1), too_short(1)}).at("worst_seams"),
            Json::array());
}

TEST(WorstSeamsTest, AreInTheOrderOfDiscrepancyLengthAndVertices) {
  const Seams edges{between(9, 10, measured(100, 1)), between(5, 6, measured(1, 7)),
                    between(4, 9, measured(1, 7)),    between(4, 8, measured(1, 7)),
                    between(7, 8, measured(2, 7)),    between(1, 2, measured(1, 8))};
  std::vector<double> from, to;
  for (const Json& seam : report_of("worst_seams", edges).at("worst_seams")) {
    from.push_back(seam["from"][0]);
    to.push_back(seam["to"][0]);
  }
  EXPECT_EQ(from, (std::vector<double>{1, 7, 4, 4, 5, 9}));
  EXPECT_EQ(to, (std::vector<double>{2, 8, 8, 9, 6, 10}));
}

TEST(WorstSeamsTest, AreTheTwentyWorst) {
  Seams edges;
  for (std::uint32_t i = 0; i < 50; ++i) {
    const std::uint32_t value = i * 37 % 50;  // every number below 50, in some order
    edges.push_back(between(value, 100, measured(1, value)));
  }
  const Json list = report_of("worst_seams", edges).at("worst_seams");
  ASSERT_EQ(list.size(), 20U);
  for (std::uint32_t i = 0; i < 20; ++i) EXPECT_EQ(list[i]["discrepancy"], 49 - i);
}

}  // namespace
}  // namespace atlasgauge
