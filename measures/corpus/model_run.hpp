#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/process/child_processes.hpp"
#include "io/warning_totals.hpp"

namespace atlasgauge {

/// What a process that measures one model may use.
struct ModelShare {
  std::uint64_t memory_bytes = 0;
  std::size_t threads = 1;
  std::string tmp_dir;  ///< empty: the default
};

/// The command that measures a model and writes its report to standard output. `arguments` are
/// those that change the report.
ChildCommand measure_command(const std::string& path, const std::vector<std::string>& arguments,
                             const ModelShare& share);

/// What became of it.
enum class Outcome {
  kMeasured,  ///< a report
  kFailed,    ///< the model's fault, or one of this program: the same again, however often
  kRefused,   ///< memory or disk were too little: another share may do
  kKilled,    ///< by somebody, or by a system out of memory: may go well another time
};

struct ModelOutcome {
  Outcome outcome = Outcome::kMeasured;
  std::string reason;      ///< where there is no report, in one line
  WarningTotals warnings;  ///< where there is one
};

/// Reads it from how the process ended. `root` and the slash after it are left out of reasons, so
/// that they are the same wherever the corpus lies.
ModelOutcome outcome_of(const ChildEnd& end, const std::string& root);

}  // namespace atlasgauge
