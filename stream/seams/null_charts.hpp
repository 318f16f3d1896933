#pragma once

#include <cstdint>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/mesh/records.hpp"

namespace atlasgauge {

/// The seam edges: the candidates with no face in a null chart, found in as many passes as the bits
/// of all faces need. Consumes both.
Spill<SeamCandidate> drop_null_charts(const Engine& engine, Spill<SeamCandidate> candidates,
                                      Spill<FaceId> null_faces, std::uint64_t faces);

}  // namespace atlasgauge
