#pragma once

#include <string>
#include <vector>

#include "bench/answers.hpp"

namespace atlasgauge {

/// Differences in keys that are measured; those that need the raster are not yet.
inline std::vector<std::string> measured_differences(const nlohmann::json& report,
                                                     const Answers& answers) {
  std::vector<std::string> lines = differences(report, answers);
  std::erase_if(lines, [](const std::string& line) {
    return line.starts_with("occupancy") || line.starts_with("overlap_") ||
           (line.starts_with("sf_") && !line.starts_with("sf_untrimmed"));
  });
  return lines;
}

}  // namespace atlasgauge
