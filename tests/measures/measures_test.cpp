// Every measure by itself, on groups with hand-worked numbers.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>

#include "measures/base/measure.hpp"
#include "measures/base/measure_set.hpp"
#include "tests/measures/random_groups.hpp"

namespace atlasgauge {
namespace {

Json report_of(const std::string& name, const Groups& groups,
               const MeshFacts& facts = any_facts()) {
  for (const auto& measure : all_measures()) {
    if (measure->name() != name) continue;
    feed(*measure, groups);
    Report report;
    measure->finish(facts, report);
    return report.to_json();
  }
  ADD_FAILURE() << "no measure " << name;
  return {};
}

/// Legs 3 and 4 in 3D: area 6, smallest angle atan(3/4). Legs `u` and `v` in texels.
Triangle three_four(double u, double v) {
  return whole_triangle({{0, 0, 0}, {4, 0, 0}, {0, 3, 0}}, {{0, 0}, {u, 0}, {0, v}});
}

Triangle of_kind(FaceKind kind) {
  Triangle triangle = three_four(1, 1);
  triangle.kind = kind;
  if (kind == FaceKind::kDegenerate || kind == FaceKind::kNonFinite) triangle.area_3d = 0;
  return triangle;
}

TEST(MeshSizeTest, CountsKindsAndAddsAreas) {
  Groups groups;
  groups.triangles = {three_four(1, 1),
                      of_kind(FaceKind::kWeldedDegenerate),
                      of_kind(FaceKind::kDegenerate),
                      of_kind(FaceKind::kNonFinite),
                      of_kind(FaceKind::kNonFinite),
                      whole_triangle({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 0}, {1, 0}, {0, 1}})};
  const Json json = report_of("mesh_size", groups);
  EXPECT_EQ(json["area"], 12);
  EXPECT_EQ(json["area_normalized"], 3) << "the longest side of the box is 2";
  EXPECT_EQ(json["fnzero"], 1);
  EXPECT_EQ(json["fndegen"], 1);
  EXPECT_EQ(json["faces_nonfinite"], 2);
  EXPECT_EQ(json["fn"], 1000);
  EXPECT_EQ(json["mesh"], "model.obj");
}

TEST(MeshSizeTest, BoxWithoutSizeNormalizesNothing) {
  MeshFacts facts = any_facts();
  facts.box = {};
  EXPECT_TRUE(report_of("mesh_size", {}, facts)["area_normalized"].is_null());
}

TEST(EdgesMeasureTest, CountsByFaces) {
  Groups groups;
  groups.raw_edges = {{1, 0.5, false}, {1, 1.5, false}, {2, 9, true}, {3, 9, false}};
  const Json json = report_of("edges", groups);
  EXPECT_EQ(json["en"], 4);
  EXPECT_EQ(json["en_b"], 2);
  EXPECT_EQ(json["nonmanif_edge"], 1);
  EXPECT_EQ(json["oriented"], true);
  EXPECT_EQ(json["boundary_len"], 2);
  EXPECT_EQ(json["boundary_len_normalized"], 1);
}

TEST(EdgesMeasureTest, OneIncoherentEdgeSpoilsTheOrientation) {
  Groups groups;
  groups.raw_edges = {{2, 9, true}, {2, 9, false}};
  EXPECT_EQ(report_of("edges", groups)["oriented"], false);
}

/// A tetrahedron: 4 vertices, 6 edges, 4 faces.
Groups tetrahedron() {
  Groups groups;
  groups.raw_edges.assign(6, {2, 1, true});
  groups.stars.assign(4, {3, 0, false, true, 0});
  groups.components = {{4, true}};
  return groups;
}

MeshFacts closed_facts() {
  MeshFacts facts = any_facts();
  facts.positions = 6;
  facts.boundary_components = 0;
  return facts;
}

TEST(TopologyTest, TetrahedronIsASphere) {
  const Json json = report_of("topology", tetrahedron(), closed_facts());
  EXPECT_EQ(json["euler"], 2);
  EXPECT_EQ(json["genus"], 0);
  EXPECT_EQ(json["boundary_loops"], 0);
  EXPECT_EQ(json["connected_components"], 1);
  EXPECT_EQ(json["largest_component_fn"], 4);
  EXPECT_EQ(json["orientable"], true);
  EXPECT_EQ(json["vnunref"], 2);
}

TEST(TopologyTest, TorusHasGenusOne) {
  Groups groups;  // nine quads as eighteen triangles
  groups.raw_edges.assign(27, {2, 1, true});
  groups.stars.assign(9, {6, 0, false, true, 0});
  groups.components = {{18, true}};
  MeshFacts facts = closed_facts();
  facts.positions = 9;
  EXPECT_EQ(report_of("topology", groups, facts)["genus"], 1);
}

TEST(TopologyTest, TriangleIsADisk) {
  Groups groups;
  groups.raw_edges.assign(3, {1, 1, false});
  groups.stars.assign(3, {1, 2, false, true, 0});
  groups.components = {{1, true}};
  MeshFacts facts = closed_facts();
  facts.boundary_components = 1;
  const Json json = report_of("topology", groups, facts);
  EXPECT_EQ(json["euler"], 1);
  EXPECT_EQ(json["genus"], 0);
  EXPECT_EQ(json["boundary_loops"], 1);
}

TEST(TopologyTest, GenusIsTruncated) {
  // A Moebius strip of 3 quads: V 6, E 12, F 6, one loop: -(6 + 6 - 12 + 1 - 2) / 2 = 0.5.
  Groups groups;
  groups.raw_edges.assign(12, {2, 1, true});
  groups.stars.assign(6, {3, 2, false, true, 0});
  groups.components = {{6, false}};
  MeshFacts facts = closed_facts();
  facts.boundary_components = 1;
  const Json json = report_of("topology", groups, facts);
  EXPECT_EQ(json["genus"], 0);
  EXPECT_EQ(json["orientable"], false);
}

TEST(TopologyTest, NonManifoldHasNoLoopsAndNoGenus) {
  Groups edge = tetrahedron(), vertex = tetrahedron();
  edge.raw_edges[0].faces = 3;
  vertex.stars[0].one_fan = false;
  for (const Groups& groups : {edge, vertex}) {
    const Json json = report_of("topology", groups, closed_facts());
    EXPECT_EQ(json["genus"], -1);
    EXPECT_EQ(json["boundary_loops"], -1);
    EXPECT_EQ(json["boundary_components"], 0);
  }
  EXPECT_EQ(report_of("topology", vertex)["nonmanif_vert"], 1);
}

TEST(TopologyTest, VertexOnANonManifoldEdgeIsNotCountedAgain) {
  Groups groups = tetrahedron();
  groups.stars[0].one_fan = false;
  groups.stars[0].nonmanifold_edge = true;
  EXPECT_EQ(report_of("topology", groups)["nonmanif_vert"], 0);
}

TEST(TopologyTest, DuplicateFacesAddUp) {
  Groups groups = tetrahedron();
  groups.stars[1].duplicate_faces = 2;
  groups.stars[3].duplicate_faces = 1;
  EXPECT_EQ(report_of("topology", groups)["fndup"], 3);
}

TEST(TopologyTest, LargestComponentOfNothingIsZero) {
  EXPECT_EQ(report_of("topology", {})["largest_component_fn"], 0);
}

TEST(ChartsMeasureTest, Counts) {
  Groups groups;
  groups.charts = {{FaceId{0}, 5, false, true, 2},
                   {FaceId{3}, 1, true, true, 0},
                   {FaceId{9}, 4, false, false, 1}};
  const Json json = report_of("charts", groups);
  EXPECT_EQ(json["num_charts"], 3);
  EXPECT_EQ(json["num_null_charts"], 1);
  EXPECT_EQ(json["charts_nonorientable"], 1);
  EXPECT_EQ(json["nfolds"], 3);
}

TEST(CrumblinessTest, SquareChart) {
  // A square of 10 x 10 texels: perimeter 40, area 100, C = 40 / sqrt(400 pi) = 2 / sqrt(pi).
  Groups groups;
  groups.uv_edges.assign(4, {1, 10});
  groups.uv_edges.push_back({2, 99});
  groups.triangles.assign(2, three_four(10, 10));
  groups.triangles.push_back(of_kind(FaceKind::kWeldedDegenerate));
  const Json json = report_of("crumbliness", groups);
  EXPECT_EQ(json["en_uv"], 5);
  EXPECT_EQ(json["en_uv_b"], 4);
  EXPECT_EQ(json["boundary_len_uv"], 40);
  EXPECT_EQ(json["area_uv"], 100);
  EXPECT_DOUBLE_EQ(json["crumbliness"], 2 / std::sqrt(std::numbers::pi));
  EXPECT_DOUBLE_EQ(json["solidity"], std::sqrt(std::numbers::pi) / 2);
}

TEST(CrumblinessTest, MirroredAreasCountAsAreas) {
  Groups groups;
  groups.triangles = {three_four(10, 10), three_four(-10, 10)};
  EXPECT_EQ(report_of("crumbliness", groups)["area_uv"], 100);
}

TEST(CrumblinessTest, NothingMappedIsNull) {
  const Json json = report_of("crumbliness", {});
  EXPECT_TRUE(json["crumbliness"].is_null());
  EXPECT_TRUE(json["solidity"].is_null());
}

TEST(MappedFractionTest, UnmappedFaceTakesItsShare) {
  Groups groups;
  groups.triangles.assign(3, three_four(1, 1));
  groups.triangles.push_back(three_four(1, 0));
  groups.triangles.push_back(of_kind(FaceKind::kWeldedDegenerate));
  EXPECT_EQ(report_of("mapped_fraction", groups)["mapped_fraction"], 0.75);
}

TEST(DistortionTest, ConformalAndStretched) {
  Groups groups;
  groups.triangles = {three_four(4, 3), three_four(8, 3)};
  const Json json = report_of("distortion", groups);
  EXPECT_EQ(json["qcd_min"], 1);
  EXPECT_EQ(json["qcd_max"], 2);
  EXPECT_EQ(json["qcd_avg"], 1.5);
  EXPECT_EQ(json["qcd_var"], 0.25);
  EXPECT_EQ(json["qcd_discardedArea"], 0);
}

TEST(DistortionTest, AHundredAndMoreIsDiscarded) {
  Groups groups;
  groups.triangles = {three_four(4, 3), three_four(400, 3), three_four(4, 300), three_four(4, 297)};
  const Json json = report_of("distortion", groups);
  EXPECT_EQ(json["qcd_discardedArea"], 12);
  EXPECT_EQ(json["qcd_max"], 99);
}

TEST(DistortionTest, PercentilesAreTheRisingOnesAndTheInverseOfTheFalling) {
  EXPECT_EQ(report_of("distortion", {})["qcd_perc50"], 1);
  EXPECT_EQ(report_of("distortion", {})["conformality_perc50"], 0.5);
}

TEST(DistortionTest, KeepsSamplesBelowAHundred) {
  for (const auto& measure : all_measures()) {
    if (measure->name() != "distortion") continue;
    EXPECT_LT(measure->cutoff(), 100);
    EXPECT_EQ(std::nextafter(measure->cutoff(), 200), 100);
  }
}

TEST(DistortionTest, ConformalityIsTheInverseWithoutACut) {
  Groups groups;
  groups.triangles = {three_four(4, 3), three_four(8, 3), three_four(4, 3 * 1024)};
  const Json json = report_of("distortion", groups);
  EXPECT_EQ(json["conformality_min"], 1.0 / 1024);
  EXPECT_EQ(json["conformality_max"], 1);
}

TEST(ScalingTest, AverageIsOneAndVarianceIsRelative) {
  // Ratios 1 and 3 on equal areas: mean 2, variance 1, relative to the mean squared 1/4.
  Groups groups;
  groups.triangles = {three_four(4, 3), three_four(12, 3)};
  const Json json = report_of("scaling", groups);
  EXPECT_EQ(json["sf_untrimmed_avg"], 1);
  EXPECT_EQ(json["sf_untrimmed_var"], 0.25);
}

/// A level of 10 x 10 texels, half of them covered.
TextureLevel half_covered() {
  TextureLevel level{SlotId{0}, 0, 10, 10, {}};
  level.counts.covered = 50;
  return level;
}

TEST(ScalingTest, CutsAtAHundredTimesTheCoveredTexelsByArea) {
  // 100 / (2 faces of area 6) * (0.5 occupied * 100 texels)
  Groups groups;
  groups.triangles = {three_four(4, 3), three_four(12, 3)};
  groups.levels = {half_covered()};
  for (const auto& measure : all_measures()) {
    if (measure->name() != "scaling") continue;
    EXPECT_EQ(measure->cutoff(), std::numeric_limits<double>::infinity());
    feed(*measure, groups);
    EXPECT_DOUBLE_EQ(measure->cutoff(), 5000.0 / 12);
  }
}

TEST(ScalingTest, WhatIsCutIsTakenBack) {
  // Kept: ratios 1 and 3 on equal areas, in units of their mean of 2.
  Groups groups;
  groups.triangles = {three_four(4, 3), three_four(12, 3), three_four(4000, 3)};
  MeshFacts facts = any_facts();
  facts.distributions.at("scaling").largest_kept = 3;
  for (const auto& measure : all_measures()) {
    if (measure->name() != "scaling") continue;
    feed(*measure, groups);
    measure->cut(0, {1000, 6});
    Report report;
    measure->finish(facts, report);
    EXPECT_EQ(report.at("sf_min"), 0.5);
    EXPECT_EQ(report.at("sf_max"), 1.5);
    EXPECT_EQ(report.at("sf_avg"), 1);
    EXPECT_EQ(report.at("sf_var"), 0.25);
    EXPECT_EQ(report.at("sf_discardedArea"), 6);
    EXPECT_EQ(report.at("sf_perc50"), 0.5);
    EXPECT_GT(report.at("sf_untrimmed_var").get<double>(), 1);
  }
}

TEST(QuantizationTest, TellsStepsInModelUnitsAndTexels) {
  MeshFacts facts = any_facts();
  const Json json = report_of("quantization", {}, facts);
  ASSERT_EQ(json["quantization"].size(), 1U);
  const Json& input = json["quantization"][0];
  EXPECT_EQ(input["input"], "a.drc");
  EXPECT_EQ(input["parts"], 2);
  EXPECT_EQ(input["quantized_parts"], 1);
  EXPECT_EQ(input["position_bits"], 14);
  EXPECT_EQ(input["position_step"], 0.5);
  EXPECT_EQ(input["uv_bits"], 12);
  EXPECT_EQ(input["uv_step_texels"], 1) << "a quarter of four texels";
}

TEST(QuantizationTest, WhatIsNotQuantizedHasNoStep) {
  MeshFacts facts = any_facts();
  facts.quantizations[0].position_bits = facts.quantizations[0].uv_bits = 0;
  const Json json = report_of("quantization", {}, facts);
  EXPECT_TRUE(json["quantization"][0]["position_step"].is_null());
  EXPECT_TRUE(json["quantization"][0]["uv_step_texels"].is_null());
  facts.quantizations.clear();
  EXPECT_FALSE(report_of("quantization", {}, facts).contains("quantization"));
  EXPECT_FALSE(report_of("quantization", {}, facts).contains("cracks"));
}

TEST(QuantizationTest, CracksAreCountedWithTheirLength) {
  Groups groups;
  groups.cracks = {{1}, {2.5}};
  const Json json = report_of("quantization", groups);
  EXPECT_EQ(json["cracks"], 2);
  EXPECT_EQ(json["cracks_len"], 3.5);
}

TEST(TexelOverlapTest, CountsLevelZeroOfUsedSlots) {
  Groups groups;
  TextureLevel unused{SlotId{1}, 0, 10, 10, {}};
  TextureLevel second = half_covered();
  second.level = 1;
  groups.levels = {half_covered(), unused, second};
  groups.levels[0].counts.overwritten = 7;
  groups.levels[0].counts.overlaps_between = 3;
  const Json json = report_of("texel_overlap", groups);
  EXPECT_EQ(json["occupancy"], 0.5);
  EXPECT_EQ(json["overlap_within_chart_texels"], 4);
  EXPECT_EQ(json["overlap_between_charts_texels"], 3);
}

TEST(TexelOverlapTest, NothingIsCountedUnderTheUnitSlot) {
  MeshFacts facts = any_facts();
  facts.textures.unit_slot = true;
  const Json json = report_of("texel_overlap", {}, facts);
  EXPECT_TRUE(json["occupancy"].is_null());
  EXPECT_TRUE(json["overlap_within_chart_texels"].is_null());
}

Chart chart_of(double area_uv, double width, double height) {
  Chart chart{};
  chart.area_uv = area_uv;
  chart.width = width;
  chart.height = height;
  return chart;
}

TEST(ChartSizeTest, ThinChartsByNumberAndByArea) {
  Groups groups;
  groups.charts = {chart_of(30, 8, 8), chart_of(10, 7.9, 100), chart_of(60, 8, 9),
                   chart_of(0, 0, 0)};
  groups.charts.back().null = true;
  const Json json = report_of("chart_area", groups);
  EXPECT_EQ(json["thin_charts_fraction"], 1.0 / 3);
  EXPECT_EQ(json["thin_charts_area_fraction"], 0.1);
  EXPECT_EQ(json["chart_area_min"], 10);
  EXPECT_DOUBLE_EQ(json["chart_area_avg"], 100.0 / 3);
}

TEST(ScalingTest, NothingMappedIsNull) {
  EXPECT_TRUE(report_of("scaling", {})["sf_untrimmed_avg"].is_null());
}

TEST(TexelDensityTest, IsTheRootOfTheAreaRatio) {
  Groups groups;
  groups.triangles = {three_four(4, 3), three_four(-12, 9)};
  const Json json = report_of("texel_density", groups);
  EXPECT_EQ(json["texel_density_min"], 1);
  EXPECT_EQ(json["texel_density_max"], 3);
  EXPECT_EQ(json["texel_density_avg"], 2);
}

TEST(TriangleShapeTest, SmallestAngleInDegrees) {
  Groups groups;
  groups.triangles = {three_four(1, 1)};
  EXPECT_NEAR(report_of("angle_min", groups)["angle_min_avg"].get<double>(), 36.86989764584402,
              1e-13);
}

TEST(TriangleShapeTest, AnyCornerMayBeTheSmallest) {
  const Position p[3] = {{0, 0, 0}, {10, 0, 0}, {10, 1, 0}};
  for (int turn = 0; turn < 3; ++turn) {
    Groups groups;
    groups.triangles = {
        whole_triangle({p[turn], p[(turn + 1) % 3], p[(turn + 2) % 3]}, {{0, 0}, {1, 0}, {0, 1}})};
    EXPECT_NEAR(report_of("angle_min", groups)["angle_min_avg"].get<double>(),
                std::atan(0.1) * 180 / std::numbers::pi, 1e-13);
  }
}

TEST(TriangleShapeTest, EquilateralIsSixty) {
  Groups groups;
  groups.triangles = {whole_triangle({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 0}, {1, 0}, {0, 1}})};
  EXPECT_NEAR(report_of("angle_min", groups)["angle_min_min"].get<double>(), 60, 1e-13);
}

TEST(TriangleShapeTest, ZeroAreaIsLeftOut) {
  Groups groups;
  groups.triangles = {whole_triangle({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 0}, {1, 0}, {0, 1}})};
  EXPECT_TRUE(report_of("angle_min", groups)["angle_min_avg"].is_null());
}

TEST(TextureUseTest, EveryFaultIsCountedOnce) {
  Triangle unmapped = three_four(1, 1), outside = three_four(2, 1), untextured = three_four(1, 1),
           unsized = three_four(1, 1), far = three_four(1, 1);
  unmapped.t[0] = unmapped.t[2] = kNoTexCoord;
  untextured.slot = kNone<SlotId>;
  unsized.slot_has_size = false;
  far.uv_far = true;
  Groups groups;
  groups.triangles = {three_four(1, 1),
                      unmapped,
                      outside,
                      untextured,
                      unsized,
                      far,
                      of_kind(FaceKind::kDegenerate)};
  const Json json = report_of("texture_use", groups);
  EXPECT_EQ(json["faces_unmapped"], 1);
  EXPECT_EQ(json["faces_uv_outside"], 1);
  EXPECT_EQ(json["faces_untextured"], 2);
  EXPECT_EQ(json["uv_far"], 1);
  EXPECT_EQ(json["ntex"], 1);
  EXPECT_EQ(json["textures"], Json::array({"image.png"}));
}

TEST(TextureUseTest, WithoutImagesNoFaceIsUntextured) {
  MeshFacts facts = any_facts();
  facts.textures.has_images = false;
  Groups groups;
  groups.triangles = {three_four(1, 1)};
  groups.triangles[0].slot_has_size = false;
  EXPECT_EQ(report_of("texture_use", groups, facts)["faces_untextured"], 0);
}

TEST(MeasureSetTest, WorkersTogetherMakeTheReportOfOne) {
  const MeshFacts facts = any_facts();
  std::string of_one;
  for (const std::size_t workers : {1U, 2U, 3U}) {
    MeasureSet set(workers);
    RandomGroups random(5);
    for (std::size_t i = 0; i < 30; ++i) {
      GroupSink& sink = set.of_worker(random.below(3) % workers);
      const Groups groups = RandomGroups(static_cast<unsigned>(i)).some(50);
      sink.accept(std::span(groups.triangles));
      sink.accept(std::span(groups.raw_edges));
      sink.accept(std::span(groups.charts));
      std::vector<Sample> samples;
      for (std::size_t k = 0; k < set.distributions().size(); ++k) {
        sink.sample(k, std::span(groups.triangles), samples);
      }
    }
    const std::string report = set.finish(facts).to_json().dump();
    if (workers == 1) of_one = report;
    EXPECT_EQ(report, of_one);
  }
}

TEST(MeasureSetTest, DistributionsAreTheSampledMeasuresByName) {
  EXPECT_EQ(MeasureSet(2).distributions(),
            (std::vector<std::string>{"angle_min", "chart_area", "distortion", "scaling"}));
}

}  // namespace
}  // namespace atlasgauge
