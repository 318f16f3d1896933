#include "measures/base/measure.hpp"
#include "measures/mapping.hpp"
#include "stream/engine/exact_sum.hpp"

namespace atlasgauge {
namespace {

/// How much of the surface has texels.
struct MappedFraction {
  static constexpr std::string_view name = "mapped_fraction";

  ExactSum mapped_area, area;  // model units squared

  void accumulate(const Triangle& triangle) {
    if (!triangle.at_welded_level()) return;
    area.add(triangle.area_3d);
    if (is_mapped(triangle)) mapped_area.add(triangle.area_3d);
  }

  void merge(const MappedFraction& other) {
    mapped_area.merge(other.mapped_area);
    area.merge(other.area);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(mapped_area, area);
  }

  void finish(const MeshFacts&, Report& report) const {
    report.set("mapped_fraction", mapped_area.value() / area.value());
  }
};

const Registered<MappedFraction> registered;

}  // namespace
}  // namespace atlasgauge
