#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/mesh/records.hpp"
#include "stream/seams/seam_rule.hpp"

namespace atlasgauge {

/// Seam edges to be sampled, numbered, by one rule or two. A rule and a side make a lane.
class SeamEdges {
 public:
  static constexpr std::size_t kRules = 2;
  static constexpr std::size_t kLanes = 2 * kRules;
  static constexpr std::uint8_t lane_of(std::size_t rule, std::size_t side) {
    return static_cast<std::uint8_t>(2 * rule + side);
  }

  SeamEdges(Spill<SeamCandidate> edges, const SlotFrames& frames, bool texmetro)
      : edges_(std::move(edges)), frames_(frames), rules_(texmetro ? kRules : 1) {}

  std::uint64_t size() const { return edges_.size(); }
  std::size_t block_count() const { return edges_.block_count(); }
  const Spill<SeamCandidate>& spill() const { return edges_; }

  /// Rule 0 is that of the specification, rule 1 that of TexMetro.
  std::size_t rules() const { return rules_; }
  SeamSamples samples(const SeamCandidate& edge, std::size_t rule) const {
    static constexpr std::array<SeamRule, kRules> kAll{kSeamRule, kTexMetroRule};
    return samples_of(edge, frames_, kAll[rule]);
  }

  /// Calls use(worker, number, edge) for all edges, on all workers; takes a block of memory each.
  template <class Use>
  void visit(const Engine& engine, StageLog::Stage& stage, Use use) const {
    std::vector<BlockBuffer> buffers(engine.workers.count());
    engine.workers.for_each(block_count(), [&](std::size_t worker, std::size_t block) {
      auto number = static_cast<std::uint32_t>(block * edges_.records_per_block());
      for (const SeamCandidate& edge : edges_.load(block, buffers[worker])) {
        use(worker, number++, edge);
      }
      if (worker == 0) stage.progress(block + 1);
    });
  }

 private:
  Spill<SeamCandidate> edges_;
  const SlotFrames& frames_;
  std::size_t rules_;
};

}  // namespace atlasgauge
