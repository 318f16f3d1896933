#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/end_to_end/cost_text.hpp"
#include "bench/end_to_end/site_plan.hpp"

namespace atlasgauge {

/// What a run of the program on a site took.
struct RunFigures {
  double wall_seconds = 0, user_seconds = 0, system_seconds = 0;
  double peak_resident_bytes = 0;
  CostText cost;

  double cpu_seconds() const { return user_seconds + system_seconds; }
};

/// Every figure is the median of that figure over the runs, those of stages too. Runs of one
/// setting have the same stages.
RunFigures median_of(const std::vector<RunFigures>& runs);

/// Runs of one site with one number of threads.
struct SiteResult {
  SitePlan site;        ///< as made
  double multiple = 0;  ///< of the budget that was asked for
  double budget_bytes = 0;
  std::uint64_t threads = 0;
  std::vector<RunFigures> runs;
};

nlohmann::json to_json(const SiteResult& result);

/// A line for every site and number of threads.
std::string table_of(const std::vector<SiteResult>& results);

/// Stage by stage, for the results on one site: with two numbers of threads or more, the wall time
/// of the first over that of the last.
std::string stage_table_of(const std::vector<SiteResult>& of_one_site);

}  // namespace atlasgauge
