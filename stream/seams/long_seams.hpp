#pragma once

#include <cstdint>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/seams/seam_edges.hpp"
#include "stream/seams/texel_store.hpp"

namespace atlasgauge {

/// Samples the edges with these numbers one by one, texel by texel, through a cache of tiles: a
/// long edge stays in a tile for many samples, and where it repeats a texture it comes back to the
/// same ones. Takes no scratch, however long an edge is.
void compare_along(const Engine& engine, const SeamEdges& edges, const TexelStore& store,
                   Spill<std::uint32_t> numbers, const OnCompared& on_edge);

}  // namespace atlasgauge
