#pragma once

#include <cstdint>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/records.hpp"

namespace atlasgauge {

/// Hands out the seam edges: the candidates with no face in a null chart. Consumes both.
void group_seams(const Engine& engine, Spill<SeamCandidate> candidates, Spill<FaceId> null_faces,
                 std::uint64_t faces, GroupSinks& sinks);

}  // namespace atlasgauge
