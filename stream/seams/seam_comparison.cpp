#include "stream/seams/seam_comparison.hpp"

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "stream/engine/page_cache.hpp"
#include "stream/engine/partition.hpp"
#include "stream/seams/footprint_colours.hpp"

namespace atlasgauge {
namespace {

/// The answers of one lane, in order.
class Answers {
 public:
  Answers(std::span<const TexelAnswer> answers, TexelKind kind)
      : next_(answers.data()), kind_(kind) {}

  void read(const Footprint&, CornerColours& corners) {
    for (unsigned known = 0; known != 15; ++next_) {
      for (unsigned c = 0; c < 4; ++c) {
        if ((next_->part.corners >> c & 1) == 0) continue;
        const std::size_t at = kind_ == TexelKind::kByte ? c * TexelAnswer::kByteTexels : 0;
        corners[c] = colour_of(next_->texels + at, kind_);
      }
      known |= next_->part.corners;
    }
  }

 private:
  const TexelAnswer* next_;
  TexelKind kind_;
};

SeamDistances distances_of(const SeamEdges& edges, const TexelStore& store,
                           const SeamCandidate& edge, std::span<TexelAnswer> answers) {
  std::sort(answers.begin(), answers.end(), [](const TexelAnswer& a, const TexelAnswer& b) {
    return a.part.place() < b.part.place();
  });
  return edges.distances(edge, [&](std::size_t rule, std::size_t side) {
    const std::uint8_t lane = SeamEdges::lane_of(rule, side);
    const auto first = std::partition_point(
        answers.begin(), answers.end(), [&](const TexelAnswer& a) { return a.part.lane < lane; });
    return Answers({first, answers.end()}, store.image(edge.sides[side].slot).kind);
  });
}

}  // namespace

void compare_sides(const Engine& engine, const SeamEdges& edges, const TexelStore& store,
                   KeyedGroups<TexelAnswer>::Buckets answers, const OnCompared& on_edge,
                   SharedSpill<std::uint32_t>::Writer& left_over) {
  if (answers.spills.empty()) return;
  StageLog::Stage stage(engine.log, "seam colours", answers.spills.size());
  const std::uint64_t page_bytes = PageLayout<SeamCandidate>::kBytes;
  const Reservation memory =
      engine.budget.reserve(engine.workers.count() * page_bytes, "comparing seams");
  // Of a bucket the edges come in order.
  std::vector<PageCache<SeamCandidate>> pages;
  for (std::size_t i = 0; i < engine.workers.count(); ++i) {
    pages.emplace_back(edges.spill(), page_bytes);
  }
  KeyedGroups<TexelAnswer> groups(
      engine,
      [&](std::size_t worker, std::span<TexelAnswer> group) {
        const SeamCandidate& edge = pages[worker].at(group[0].part.seam);
        on_edge(worker, edge, distances_of(edges, store, edge, group));
      },
      [&](std::uint32_t number, Spill<TexelAnswer>) { left_over.push(number); });
  groups.process(std::move(answers), &stage);
}

}  // namespace atlasgauge
