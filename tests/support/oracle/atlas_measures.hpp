#pragma once

#include <nlohmann/json.hpp>

#include "tests/support/oracle/levels.hpp"

namespace atlasgauge::oracle {

// The keys of the atlas that follow from its triangles, edges and charts alone.
void report_atlas(nlohmann::json& report, const Analysis& analysis);

}  // namespace atlasgauge::oracle
