#include "stream/mesh/charts.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "stream/engine/keyed_groups.hpp"

namespace atlasgauge {
namespace {

__extension__ typedef __int128 Int128;

/// A face in its chart.
struct ChartFace {
  std::uint32_t chart;
  std::uint32_t face_and_flags;
  double area_uv;

  static constexpr std::uint32_t kFlipped = 1U << 30;
  static constexpr std::uint32_t kConflict = 1U << 31;

  std::uint32_t key() const { return chart; }
  FaceId face() const { return FaceId{face_and_flags & ~(kFlipped | kConflict)}; }
  bool flipped() const { return (face_and_flags & kFlipped) != 0; }
  bool conflict() const { return (face_and_flags & kConflict) != 0; }
};
static_assert(sizeof(ChartFace) == 16);

/// Adds up one chart. Areas are summed in fixed point, in units of 2^-62 of the largest face, so
/// that the total does not depend on the order of the faces; their signs are taken before rounding.
class ChartSum {
 public:
  ChartSum(std::uint32_t chart, double largest_area_uv)
      : chart_(chart), scale_(62 - std::ilogb(std::max(largest_area_uv, 1e-300)) - 1) {}

  void add(const ChartFace& face) {
    ++faces_;
    conflict_ = conflict_ || face.conflict();
    if (face.area_uv == 0) return;
    const auto area = static_cast<Int128>(std::llrint(std::scalbn(face.area_uv, scale_)));
    absolute_ += area < 0 ? -area : area;
    as_is_.add(area, face.area_uv > 0);
    coherent_.add(face.flipped() ? -area : area, (face.area_uv > 0) != face.flipped());
  }

  Chart finish() const {
    const bool null = as_is_.positive + as_is_.negative == 0;
    return {FaceId{chart_}, faces_, null, !conflict_,
            (conflict_ ? as_is_ : coherent_).folds(absolute_)};
  }

 private:
  struct Signs {
    Int128 total = 0;
    std::uint64_t positive = 0, negative = 0;

    void add(Int128 area, bool is_positive) {
      total += area;
      ++(is_positive ? positive : negative);
    }
    /// Faces against the sign of the total; of a chart closed in UV (|total| <= 1e-9 of the sum of
    /// absolute areas), the fewer.
    std::uint64_t folds(Int128 absolute) const {
      const Int128 size = total < 0 ? -total : total;
      if (static_cast<double>(size) <= 1e-9 * static_cast<double>(absolute)) {
        return std::min(positive, negative);
      }
      return total > 0 ? negative : positive;
    }
  };

  std::uint32_t chart_;
  int scale_;
  std::uint64_t faces_ = 0;
  bool conflict_ = false;
  Int128 absolute_ = 0;
  Signs as_is_, coherent_;
};

KeyedGroups<ChartFace>::Buckets distribute_faces(const Engine& engine, FaceLabels& labels,
                                                 Spill<FaceFacts>& facts) {
  const auto push_faces = [&](auto push) {
    SpillReader<Label> charts(labels.by_all_edges());
    SpillReader<Label> classes(labels.by_manifold_edges());
    SpillReader<FaceFacts> faces(facts);
    FaceFacts face;
    Label chart, orientation;
    for (std::uint32_t number = 0;
         faces.read(face) && charts.read(chart) && classes.read(orientation); ++number) {
      if (!face.at_welded_level()) continue;
      const std::uint32_t flags = (orientation.parity() ? ChartFace::kFlipped : 0) |
                                  (orientation.conflict() ? ChartFace::kConflict : 0);
      push({chart.first(), number | flags, face.area_uv()});
    }
  };
  return KeyedGroups<ChartFace>::distribute(engine, facts.size(), facts.size(),
                                            "distributing faces to charts", push_faces);
}

}  // namespace

Spill<FaceId> group_charts(const Engine& engine, FaceLabels& labels, Spill<FaceFacts>& facts,
                           double largest_area_uv, GroupSinks& sinks) {
  SharedSpill<FaceId> null_faces(engine.scratch);
  std::vector<SharedSpill<FaceId>::Writer> null_writers;
  std::vector<GroupBuffer<Chart>> outputs;
  for (std::size_t i = 0; i < engine.workers.count(); ++i) {
    outputs.emplace_back(sinks.of_worker(i));
    null_writers.emplace_back(null_faces);
  }
  KeyedGroups<ChartFace> groups(
      engine,
      [&](std::size_t worker, std::span<ChartFace> faces) {
        ChartSum sum(faces[0].chart, largest_area_uv);
        for (const ChartFace& face : faces) sum.add(face);
        const Chart chart = sum.finish();
        outputs[worker].push(chart);
        if (!chart.null) return;
        for (const ChartFace& face : faces) null_writers[worker].push(face.face());
      },
      [&](std::uint32_t number, Spill<ChartFace> faces) {
        ChartSum sum(number, largest_area_uv);
        ChartFace face{};
        for (SpillReader<ChartFace> reader(faces); reader.read(face);) sum.add(face);
        const Chart chart = sum.finish();
        outputs[0].push(chart);
        if (!chart.null) return;
        for (SpillReader<ChartFace> reader(faces); reader.read(face);) {
          null_writers[0].push(face.face());
        }
      });
  groups.process(distribute_faces(engine, labels, facts));
  for (auto& output : outputs) output.flush();
  for (auto& writer : null_writers) writer.flush();
  return null_faces.finish();
}

}  // namespace atlasgauge
