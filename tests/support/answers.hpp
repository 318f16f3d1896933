#pragma once

#include <string>
#include <vector>

#include "bench/answers.hpp"
#include "tests/support/pending_keys.hpp"

namespace atlasgauge {

/// Differences in keys that are measured.
inline std::vector<std::string> measured_differences(const nlohmann::json& report,
                                                     const Answers& answers) {
  std::vector<std::string> lines = differences(report, answers);
  std::erase_if(lines, is_pending);
  return lines;
}

}  // namespace atlasgauge
