#pragma once

#include <algorithm>
#include <cstdint>

#include "stream/engine/partition.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/records.hpp"
#include "stream/seams/texture_sums.hpp"

namespace atlasgauge {

/// A seam edge whose colours are not compared.
inline SeamEdge unmeasured(const SeamCandidate& candidate, bool sampled) {
  SeamEdge edge;
  std::copy(candidate.v, candidate.v + 2, edge.v);
  std::copy(candidate.sides, candidate.sides + 2, edge.sides);
  edge.length_3d = candidate.length_3d;
  edge.sampled = sampled;
  return edge;
}

/// Where one worker hands its finished seam edges.
class SeamOutput {
 public:
  SeamOutput(GroupSink& sink, SharedSpill<TextureSample>& textures, SharedSpill<SeamEdge>& kept,
             bool keep)
      : groups_(sink), textures_(textures), kept_(kept), keep_(keep) {}

  void push(const SeamEdge& edge) {
    groups_.push(edge);
    if (keep_) kept_.push(edge);
    if (edge.samples == 0) return;
    sample_pairs_ += edge.samples;
    textures_.push({edge.sides[0].slot, 0, edge.length_3d, edge.discrepancy});
    if (edge.sides[1].slot == edge.sides[0].slot) return;
    textures_.push({edge.sides[1].slot, 0, edge.length_3d, edge.discrepancy});
  }

  void flush() {
    groups_.flush();
    textures_.flush();
    kept_.flush();
  }
  /// An edge on texels that are not numbers.
  void push_nonfinite(const SeamEdge& edge) {
    ++nonfinite_;
    push(edge);
  }

  std::uint64_t sample_pairs() const { return sample_pairs_; }
  std::uint64_t nonfinite() const { return nonfinite_; }

 private:
  GroupBuffer<SeamEdge> groups_;
  SharedSpill<TextureSample>::Writer textures_;
  SharedSpill<SeamEdge>::Writer kept_;
  bool keep_;
  std::uint64_t sample_pairs_ = 0;
  std::uint64_t nonfinite_ = 0;
};

}  // namespace atlasgauge
