#pragma once

#include "measures/base/report.hpp"
#include "stream/pipeline.hpp"

namespace atlasgauge {

/// The mean discrepancy of the seam edges with a side on each texture, by length; null for textures
/// without any that was sampled. In the order of the slots. The stream has added it up.
Json seam_discrepancy_by_texture(const MeshFacts& facts);

}  // namespace atlasgauge
