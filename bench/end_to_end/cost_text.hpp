#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace atlasgauge {

/// What a stage cost, as `atlasgauge -v` has it: times to the millisecond, bytes to four digits.
struct StageFigures {
  std::string name;
  double wall_seconds = 0, cpu_seconds = 0;
  std::uint64_t workers = 0;
  double spilled_bytes = 0, written_bytes = 0, read_bytes = 0;
};

struct CostText {
  std::vector<StageFigures> stages;
  std::map<std::string, double> bytes;  ///< of the lines below them, as "scratch written"

  /// Throws Error(kInput) where the line is missing.
  double bytes_of(const std::string& what) const;
};

/// Reads what `atlasgauge -v` prints, among whatever else. Throws Error(kInput) if there are no
/// stages.
CostText parse_cost(const std::string& text);

}  // namespace atlasgauge
