#pragma once

#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/mesh_store.hpp"
#include "stream/mesh/records.hpp"

namespace atlasgauge {

/// Hands out CrackEdge groups. Where positions are quantized, vertices that were one in two parts
/// may have moved apart by half a step each. A welded boundary edge of one part is a crack if its
/// two ends and its middle lie within one step of boundary edges of other parts: of the larger of
/// the two parts' steps, in each coordinate, as each is rounded for itself, and as much more as a
/// float of that size is rounded. Edges of parts that quantize nothing count where the other part
/// does.
///
/// `edges` are all welded boundary edges, and are consumed.
void find_cracks(const Engine& engine, Spill<OpenEdge> edges, Spill<Position>& vertices,
                 const std::vector<PartStart>& parts, GroupSinks& sinks);

}  // namespace atlasgauge
