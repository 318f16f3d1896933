#pragma once

#include <nlohmann/json.hpp>

#include "tests/support/oracle/levels.hpp"

namespace atlasgauge::oracle {

// seam_* and worst_seams; with TexMetro's average on demand.
void report_seams(nlohmann::json& report, const Analysis& analysis, bool texmetro);

}  // namespace atlasgauge::oracle
