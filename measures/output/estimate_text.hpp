#pragma once

#include <string>

#include "measures/base/report.hpp"
#include "stream/estimate.hpp"
#include "stream/memory_plan.hpp"

namespace atlasgauge {

/// Counts and what a run costs, for people: "about 1.2 million", "under a minute".
std::string text_of(const ModelGuess& guess, const CostEstimate& cost, const MemoryPlan& plan);

/// The same for scripts: bytes, seconds and counts as integers; `time_class` is one of "seconds"
/// (under a minute), "minutes" (under an hour), "hours" (under a day) and "days".
Json json_of(const ModelGuess& guess, const CostEstimate& cost, const MemoryPlan& plan);

}  // namespace atlasgauge
