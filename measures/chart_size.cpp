#include <algorithm>

#include "measures/base/measure.hpp"
#include "measures/base/statistics.hpp"
#include "stream/engine/exact_sum.hpp"

namespace atlasgauge {
namespace {

/// How large the charts are, in texels squared, each counting once; and how many, and how much of
/// the UV area, have a box with a side shorter than 8 texels: such slivers bleed into each other at
/// the first mip levels. Over charts of nonzero UV area.
struct ChartSize {
  static constexpr std::string_view name = "chart_area";
  static constexpr double kThinTexels = 8;

  WeightedMoments moments;  // every chart weighs 1
  std::uint64_t thin = 0;
  ExactSum area, thin_area;  // texels squared

  std::optional<Sample> sample(const Chart& chart) const {
    if (chart.null) return std::nullopt;
    return Sample{chart.area_uv, 1};
  }

  void accumulate(const Sample& taken) { moments.add(taken.value, taken.weight); }

  void accumulate(const Chart& chart) {
    if (chart.null) return;
    area.add(chart.area_uv);
    if (std::min(chart.width, chart.height) >= kThinTexels) return;
    ++thin;
    thin_area.add(chart.area_uv);
  }

  void merge(const ChartSize& other) {
    moments.merge(other.moments);
    thin += other.thin;
    area.merge(other.area);
    thin_area.merge(other.thin_area);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(moments, thin, area, thin_area);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    if (facts.textures.unit_slot) return;
    report_percentiles(report, "chart_area", facts.distributions.at("chart_area").all.rising);
    report_moments(report, "chart_area", moments);
    report.set("thin_charts_fraction", static_cast<double>(thin) / moments.weight());
    report.set("thin_charts_area_fraction", thin_area.value() / area.value());
  }
};

const Registered<ChartSize> registered;

}  // namespace
}  // namespace atlasgauge
