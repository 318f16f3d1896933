#include "measures/base/measure.hpp"
#include "stream/engine/exact_sum.hpp"

namespace atlasgauge {
namespace {

/// Faces, positions, area, and faces without one.
struct MeshSize {
  static constexpr std::string_view name = "mesh_size";

  std::uint64_t zero_area = 0;
  std::uint64_t degenerate = 0;
  std::uint64_t nonfinite = 0;
  ExactSum area;  // model units squared

  void accumulate(const Triangle& triangle) {
    if (triangle.kind == FaceKind::kDegenerate) ++degenerate;
    if (triangle.kind == FaceKind::kNonFinite) ++nonfinite;
    if (!triangle.at_raw_level()) return;
    if (triangle.area_3d == 0) ++zero_area;
    area.add(triangle.area_3d);
  }

  void merge(const MeshSize& other) {
    zero_area += other.zero_area;
    degenerate += other.degenerate;
    nonfinite += other.nonfinite;
    area.merge(other.area);
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(zero_area, degenerate, nonfinite, area);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    const double side = facts.box.longest_side();
    report.set("mesh", Json(facts.name));
    report.set("fn", facts.faces);
    report.set("vn", facts.positions);
    report.set("area", area.value());
    report.set("area_normalized", area.value() / (side * side));
    report.set("fnzero", zero_area);
    report.set("fndegen", degenerate);
    report.set("faces_nonfinite", nonfinite);
    report.set("faces_invalid", facts.invalid_polygons);
    report.set("vndup", facts.duplicate_positions);
  }
};

const Registered<MeshSize> registered;

}  // namespace
}  // namespace atlasgauge
