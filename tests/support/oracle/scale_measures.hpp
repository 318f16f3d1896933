#pragma once

#include <nlohmann/json.hpp>
#include <optional>

#include "tests/support/oracle/levels.hpp"
#include "tests/support/oracle/raster.hpp"

namespace atlasgauge::oracle {

// sf_* and texel_density_*: how many texels a face gets for its size.
void report_scale(nlohmann::json& report, const Analysis& analysis,
                  const std::optional<Coverage>& coverage);

}  // namespace atlasgauge::oracle
