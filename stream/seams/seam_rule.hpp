#pragma once

#include <cstdint>
#include <utility>

#include "stream/mesh/records.hpp"
#include "stream/seams/seam_path.hpp"

namespace atlasgauge {

/// Where the samples of a seam edge lie.
struct SeamRule {
  double offset;       ///< sample i of n is at (i + offset) / n
  double slack;        ///< taken from the longer side before it is rounded up
  bool own_direction;  ///< each side runs as its own face does, not as the edge does
};

/// SPEC section 5.
inline constexpr SeamRule kSeamRule{.offset = 0.5, .slack = 1e-6, .own_direction = false};

/// As TexMetro samples: the faces on the two sides of an edge usually run it in opposite
/// directions, so that colours of opposite ends are compared. It visits an edge from both faces,
/// which gives the same distances twice.
inline constexpr SeamRule kTexMetroRule{.offset = 0, .slack = 0, .own_direction = true};

/// The samples of one edge.
struct SeamSamples {
  std::uint64_t count = 0;
  SeamPath sides[2];
};

inline SeamSamples samples_of(const SeamCandidate& edge, const SlotFrames& frames,
                              const SeamRule& rule) {
  Texel ends[2][2];
  for (int side = 0; side < 2; ++side) {
    const SlotFrame& frame = frames.of(edge.sides[side].slot);
    for (int end = 0; end < 2; ++end) ends[side][end] = frame.texel(edge.sides[side].t[end]);
  }
  SeamSamples samples;
  samples.count =
      sample_count(distance(ends[0][0], ends[0][1]), distance(ends[1][0], ends[1][1]), rule.slack);
  for (int side = 0; side < 2; ++side) {
    auto& [from, to] = ends[side];
    if (rule.own_direction && edge.runs_down[side]) std::swap(from, to);
    samples.sides[side] = SeamPath(from, to, samples.count, rule.offset);
  }
  return samples;
}

}  // namespace atlasgauge
