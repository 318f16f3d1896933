#include "measures/base/measure.hpp"
#include "measures/occupancy.hpp"

namespace atlasgauge {
namespace {

/// At mip level 0: how many texels are used, and how many more than once. Overlap within a chart
/// (a fold, or a chart that runs over itself) is told from overlap between charts (texels shared on
/// purpose, or a packing gone wrong).
struct TexelOverlap {
  static constexpr std::string_view name = "texel_overlap";

  Occupancy occupancy;
  std::uint64_t overwritten = 0;
  std::uint64_t between_charts = 0;

  void accumulate(const TextureLevel& level) {
    occupancy.add(level);
    if (level.level != 0) return;
    overwritten += level.counts.overwritten;
    between_charts += level.counts.overlaps_between;
  }

  void merge(const TexelOverlap& other) {
    occupancy.merge(other.occupancy);
    overwritten += other.overwritten;
    between_charts += other.between_charts;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(occupancy, overwritten, between_charts);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    if (facts.textures.unit_slot) return;
    report.set("occupancy", occupancy.value());
    report.set("overlap_within_chart_texels", overwritten - between_charts);
    report.set("overlap_between_charts_texels", between_charts);
  }
};

const Registered<TexelOverlap> registered;

}  // namespace
}  // namespace atlasgauge
