#pragma once

#include <cstdint>

#include "stream/engine/engine.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/engine/partition.hpp"
#include "stream/seams/seam_edges.hpp"
#include "stream/seams/texel_lookup.hpp"
#include "stream/seams/texel_store.hpp"

namespace atlasgauge {

/// Takes the samples of all edges whose texels have come. Edges with more texels than memory are
/// left over.
void compare_sides(const Engine& engine, const SeamEdges& edges, const TexelStore& store,
                   KeyedGroups<TexelAnswer>::Buckets answers, const OnCompared& on_edge,
                   SharedSpill<std::uint32_t>::Writer& left_over);

}  // namespace atlasgauge
