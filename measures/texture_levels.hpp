#pragma once

#include "measures/base/report.hpp"
#include "stream/pipeline.hpp"

namespace atlasgauge {

/// The `texture_N` of a model: what covers the texels of each slot, by mip level (SPEC section 4).
/// The stream has added it up and keeps it in scratch; `facts` must live as long as the report.
Report::Textures texture_levels(const MeshFacts& facts);

}  // namespace atlasgauge
