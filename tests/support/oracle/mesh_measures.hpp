#pragma once

#include <nlohmann/json.hpp>

#include "tests/support/oracle/levels.hpp"

namespace atlasgauge::oracle {

// The keys of the mesh, without its texture coordinates.
void report_mesh(nlohmann::json& report, const Analysis& analysis);

}  // namespace atlasgauge::oracle
