#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "stream/engine/budget.hpp"
#include "stream/engine/scratch.hpp"
#include "stream/engine/workers.hpp"

namespace atlasgauge {

/// What one stage cost. CPU is user + system time of the whole process.
struct StageCost {
  std::string name;
  double wall_seconds = 0;
  double cpu_seconds = 0;
  std::uint64_t spilled_bytes = 0;  ///< blocks that did not fit in memory
  std::uint64_t written_bytes = 0;  ///< to the scratch file
  std::uint64_t read_bytes = 0;
  std::size_t workers_busy = 0;  ///< workers that did any of its parallel work
};

/// Hears how far a stage is: its name and a fraction in [0, 1]. Must not throw: a stage that a
/// fault ends tells so too.
using Progress = std::function<void(const std::string& stage, double fraction)>;

/// Costs of the stages of a run, in order.
class StageLog {
 public:
  StageLog(const Scratch& scratch, const Workers& workers, Progress progress = {})
      : scratch_(scratch), workers_(workers), progress_(std::move(progress)) {}

  /// Lives as long as the stage runs.
  class Stage {
   public:
    Stage(StageLog& log, std::string name, std::uint64_t total_work = 0);
    ~Stage();
    Stage(const Stage&) = delete;
    Stage& operator=(const Stage&) = delete;
    /// `done` of the total work; to be called by one thread at a time.
    void progress(std::uint64_t done);

   private:
    StageLog& log_;
    std::size_t index_;  // made at the start, so that the end needs no memory
    StageCost before_;
    std::vector<std::uint64_t> items_before_;
    std::uint64_t total_work_;
    int shown_percent_ = -1;
  };

  const std::vector<StageCost>& stages() const { return stages_; }

 private:
  const Scratch& scratch_;
  const Workers& workers_;
  Progress progress_;
  std::vector<StageCost> stages_;
};

}  // namespace atlasgauge
