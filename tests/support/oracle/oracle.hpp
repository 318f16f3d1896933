#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tests/support/oracle/model.hpp"

// A second opinion on every number of the report, written from the specification alone. It shares
// no code with the program, holds everything in memory and prefers the plain way to the fast one.
//
// Values of single faces and edges are doubles by the formulas of the specification, each operation
// rounded for itself: compile with -ffp-contract=off. Sums, statistics and percentiles over them
// are taken exactly and rounded once.
namespace atlasgauge::oracle {

nlohmann::json measure(Model model, bool texmetro_seams = false);

nlohmann::json measure_obj(const std::string& obj_path, const Options& options);

}  // namespace atlasgauge::oracle
