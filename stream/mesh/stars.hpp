#pragma once

#include <cstdint>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/records.hpp"

namespace atlasgauge {

/// Groups the corners of all faces by vertex (raw level) and hands out VertexStar groups. `facts`
/// say which faces take part; `vertices` is the number of positions. Returns the number of vertices
/// on boundary edges.
std::uint64_t group_stars(const Engine& engine, Spill<FaceRecord>& faces, Spill<FaceFacts>& facts,
                          std::uint64_t vertices, GroupSinks& sinks);

}  // namespace atlasgauge
