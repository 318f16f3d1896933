#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/seams/seam_edges.hpp"
#include "stream/seams/texel_lookup.hpp"
#include "stream/seams/texel_store.hpp"

namespace atlasgauge {

/// What the samples of all edges will need.
struct TexelSurvey {
  std::vector<bool> slots;  ///< whose images they lie on
  double requests = 0;      ///< about how many
};

TexelSurvey survey_texels(const Engine& engine, const SeamEdges& edges, std::size_t slots);

/// Whether the images on both sides were decoded.
bool is_decoded(const TexelStore& store, const SeamCandidate& edge);

/// Edges that no texels are asked for; any worker.
struct UnaskedEdges {
  /// Without samples, or without a decoded image on both sides.
  std::function<void(std::size_t worker, const SeamCandidate& edge)> on_nothing;
  std::function<void(std::size_t worker, std::uint32_t number)> on_long;
};

/// Asks for the texels of all samples, by tile. Throws Error(kResource) if the answers have no
/// room.
KeyedGroups<TexelRequest>::Buckets request_texels(const Engine& engine, const SeamEdges& edges,
                                                  const TexelStore& store, double requests,
                                                  const UnaskedEdges& unasked);

}  // namespace atlasgauge
