#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "stream/engine/engine.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/seams/seam_edges.hpp"
#include "stream/seams/texel_lookup.hpp"
#include "stream/seams/texel_store.hpp"

namespace atlasgauge {

/// The mean colour distance on an edge by each rule; NaN where a rule has no samples.
using SeamDistances = std::array<double, SeamEdges::kRules>;

/// Takes the samples of all edges that asked for texels. The distances of an edge are added in the
/// order of its samples.
void compare_sides(const Engine& engine, const SeamEdges& edges, const TexelStore& store,
                   KeyedGroups<TexelAnswer>::Buckets answers,
                   const std::function<void(std::size_t worker, const SeamCandidate& edge,
                                            const SeamDistances& distances)>& on_edge);

}  // namespace atlasgauge
