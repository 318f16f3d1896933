#pragma once

#include <string>

#include "measures/base/report.hpp"
#include "stream/engine/engine.hpp"
#include "stream/memory_plan.hpp"
#include "stream/pipeline.hpp"

namespace atlasgauge {

/// The report for a person, in aligned columns.
std::string summary_of(const MeshFacts& facts, const Report& report);

/// What the run cost: stage by stage, and memory.
std::string cost_of(const Engine& engine, const MemoryPlan& plan, const MeshFacts& facts);

}  // namespace atlasgauge
