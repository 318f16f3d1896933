#pragma once

#include <cmath>
#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "measures/base/measure.hpp"
#include "stream/groups.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {

/// Some groups of every kind.
struct Groups {
  std::vector<Triangle> triangles;
  std::vector<RawEdge> raw_edges;
  std::vector<UvEdge> uv_edges;
  std::vector<SeamEdge> seam_edges;
  std::vector<VertexStar> stars;
  std::vector<Component> components;
  std::vector<Chart> charts;
  std::vector<CrackEdge> cracks;
  std::vector<TextureLevel> levels;
};

/// Hands groups over as a worker does: to sample() too, if the measure wants them.
inline void feed(AnyMeasure& measure, const Groups& groups) {
  measure.accept(std::span(groups.triangles));
  measure.accept(std::span(groups.raw_edges));
  measure.accept(std::span(groups.uv_edges));
  measure.accept(std::span(groups.seam_edges));
  measure.accept(std::span(groups.stars));
  measure.accept(std::span(groups.components));
  measure.accept(std::span(groups.charts));
  measure.accept(std::span(groups.cracks));
  measure.accept(std::span(groups.levels));
  if (!measure.sampled()) return;
  std::vector<Sample> samples;
  measure.sample(0, std::span(groups.triangles), samples);
  measure.sample(0, std::span(groups.charts), samples);
}

/// A whole face with these corners, all its texels within the texture.
inline Triangle whole_triangle(const Position (&p)[3], const Texel (&texel)[3]) {
  Triangle triangle{};
  triangle.slot = SlotId{0};
  triangle.kind = FaceKind::kWhole;
  triangle.slot_has_size = true;
  triangle.has_uv_triangle = true;
  for (int k = 0; k < 3; ++k) {
    triangle.p[k] = p[k];
    triangle.texel[k] = texel[k];
    triangle.t[k] = {static_cast<float>(texel[k].x), static_cast<float>(texel[k].y)};
  }
  triangle.area_3d = triangle_area(p[0], p[1], p[2]);
  triangle.area_uv = signed_area(texel[0], texel[1], texel[2]);
  return triangle;
}

/// Groups with numbers of very different size, and some of every special kind.
class RandomGroups {
 public:
  explicit RandomGroups(unsigned seed) : random_(seed) {}

  Groups some(std::size_t of_each) {
    Groups groups;
    for (std::size_t i = 0; i < of_each; ++i) {
      groups.triangles.push_back(triangle());
      groups.raw_edges.push_back({1 + below(4), number(), below(2) == 0});
      groups.uv_edges.push_back({1 + below(3), number()});
      groups.seam_edges.push_back(seam_edge());
      groups.stars.push_back({1 + below(9), below(3), below(5) == 0, below(3) != 0, below(2)});
      groups.components.push_back({1 + below(100), below(4) != 0});
      groups.charts.push_back(chart(static_cast<FaceId>(i)));
      groups.levels.push_back(level());
      groups.cracks.push_back({number()});
    }
    return groups;
  }

  std::uint64_t below(std::uint64_t end) { return random_() % end; }

  /// Never two with the same vertices. Many are equally bad; the longest are equally long, too.
  SeamEdge seam_edge() {
    SeamEdge edge;
    edge.v[0] = VertexId{static_cast<std::uint32_t>(below(10))};
    edge.v[1] = VertexId{10 + seam_edges_++ % (kVertices - 10)};
    for (SeamSide& side : edge.sides) {
      side.slot = SlotId{static_cast<std::uint32_t>(below(3))};
      for (TexCoord& t : side.t) t = {static_cast<float>(number()), static_cast<float>(number())};
    }
    edge.length_3d = below(2) == 0 ? number() : kMostLength;
    edge.sampled = below(4) != 0;
    edge.samples = edge.sampled ? below(100) : 0;
    if (edge.samples == 0) return edge;
    edge.discrepancy = 100 * static_cast<double>(below(5));
    edge.texmetro_discrepancy = 441 * fraction();
    return edge;
  }

  static constexpr std::uint32_t kVertices = 4096;

 private:
  static constexpr double kMostLength = 0x1p30;

  /// Up to kMostLength.
  double number() { return std::ldexp(1 + fraction(), static_cast<int>(below(60)) - 30); }
  double fraction() { return static_cast<double>(random_()) * 0x1p-32; }

  Chart chart(FaceId first_face) {
    Chart chart{first_face, 1 + below(100), below(5) == 0, below(7) != 0, below(3)};
    chart.area_uv = number();
    chart.width = 16 * fraction();
    chart.height = 16 * fraction();
    return chart;
  }

  TextureLevel level() {
    TextureLevel level{SlotId{0}, static_cast<std::uint32_t>(below(3)), 64, 64, {}};
    level.counts.covered = below(4096);
    level.counts.overwritten = level.counts.covered / 2;
    level.counts.overlaps_between = level.counts.overwritten / 2;
    return level;
  }

  Triangle triangle() {
    const double size = number(), texels = number();
    Position p[3];
    Texel texel[3];
    for (int k = 0; k < 3; ++k) {
      p[k] = {size * fraction(), size * fraction(), size * fraction()};
      texel[k] = {texels * fraction(), texels * fraction()};
    }
    const std::uint64_t kind = below(12);
    if (kind == 0) p[2] = p[1];
    if (kind == 1) texel[2] = texel[1];
    if (kind == 2) texel[2] = {texel[1].x + 1e-6 * texels, texel[1].y};
    Triangle triangle = whole_triangle(p, texel);
    triangle.uv_far = kind == 3;
    if (kind == 4) triangle.kind = FaceKind::kWeldedDegenerate;
    if (kind == 5) triangle.kind = FaceKind::kDegenerate;
    if (kind == 6) triangle.kind = FaceKind::kNonFinite;
    if (kind == 7) triangle.slot = kNone<SlotId>;
    if (kind == 8) {
      triangle.has_uv_triangle = false;
      triangle.area_uv = 0;
      triangle.t[1] = kNoTexCoord;
    }
    return triangle;
  }

  std::mt19937 random_;
  std::uint32_t seam_edges_ = 0;
};

/// Where the facts of all tests keep what they have in scratch.
inline Scratch& scratch_of_facts() {
  static TestEngine engine({.resident_bytes = 1 << 20});
  return engine.scratch;
}

template <class T>
Spill<T> spill_for_facts(const std::vector<T>& records) {
  SpillWriter<T> writer(scratch_of_facts());
  writer.append(records);
  return writer.finish();
}

/// Vertex v is at (v, v / 2, -v).
inline Spill<Position> vertices_on_a_line() {
  std::vector<Position> positions;
  for (std::uint32_t v = 0; v < RandomGroups::kVertices; ++v) {
    positions.push_back({1.0 * v, 0.5 * v, -1.0 * v});
  }
  return spill_for_facts(positions);
}

/// Facts for the end of measures, with percentiles of every distribution.
inline MeshFacts any_facts() {
  MeshFacts facts;
  facts.name = "model.obj";
  facts.faces = 1000;
  facts.positions = 100000;
  facts.boundary_components = 3;
  facts.box.add({0, 0, 0});
  facts.box.add({1, 2, 1});
  facts.textures.slots.push_back({"image.png", {.path = "image.png"}, ImageSize{4, 4}, true});
  facts.textures.has_images = true;
  facts.textures.of_material = {SlotId{0}};
  facts.quantizations.push_back({"a.drc", 2, 1, 14, 0.5, 12, {0.25}, 0});
  facts.texmetro_seams = true;
  facts.vertices = vertices_on_a_line();
  for (const auto& measure : all_measures()) {
    if (!measure->sampled()) continue;
    Quantiles quantiles{};
    quantiles.rising.fill(1);
    quantiles.falling.fill(2);
    facts.distributions.emplace(measure->name(), Distribution{quantiles, quantiles, 1});
  }
  return facts;
}

}  // namespace atlasgauge
