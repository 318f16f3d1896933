#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "stream/engine/block_visit.hpp"
#include "stream/engine/spill.hpp"
#include "stream/mesh/records.hpp"
#include "stream/seams/footprint_colours.hpp"
#include "stream/seams/seam_rule.hpp"

namespace atlasgauge {

/// The mean colour distance on an edge by each rule; NaN where a rule has no samples.
using SeamDistances = std::array<double, 2>;

/// Hears of the edges that were sampled; any worker.
using OnCompared = std::function<void(std::size_t worker, const SeamCandidate& edge,
                                      const SeamDistances& distances)>;

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

  /// Whether an edge has so many samples that its texels are better looked up along it, than
  /// fetched with those of others.
  bool is_long(const SeamCandidate& edge) const {
    constexpr std::uint64_t kMostSamples = 1 << 16;
    return samples(edge, 0).count > kMostSamples;
  }

  /// source(rule, side) is where colours come from: see FootprintColours.
  template <class Sources>
  SeamDistances distances(const SeamCandidate& edge, Sources source) const {
    SeamDistances distances;
    distances.fill(std::numeric_limits<double>::quiet_NaN());
    for (std::size_t rule = 0; rule < rules_; ++rule) {
      distances[rule] =
          mean_distance(samples(edge, rule), [&](std::size_t side) { return source(rule, side); });
    }
    return distances;
  }

  /// Calls use(worker, number, edge) for all edges, on all workers; takes a block of memory each.
  template <class Use>
  void visit(const Engine& engine, StageLog::Stage& stage, Use use) const {
    visit_blocks(engine, edges_, [&](std::size_t worker, std::size_t block, auto edges) {
      auto number = static_cast<std::uint32_t>(block * edges_.records_per_block());
      for (const SeamCandidate& edge : edges) {
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
