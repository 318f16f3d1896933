#include "stream/engine/stage_log.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace atlasgauge {
namespace {

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

double wall_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

StageCost reading(std::string name, const Scratch& scratch) {
  return {std::move(name),
          wall_seconds(),
          cpu_seconds(),
          scratch.spilled_bytes(),
          scratch.written_bytes(),
          scratch.read_bytes(),
          0};
}

}  // namespace

StageLog::Stage::Stage(StageLog& log, std::string name, std::uint64_t total_work)
    : log_(log),
      index_(log.stages_.size()),
      before_(reading(std::move(name), log.scratch_)),
      total_work_(total_work) {
  for (std::size_t i = 0; i < log.workers_.count(); ++i) {
    items_before_.push_back(log.workers_.items_done(i));
  }
  log_.stages_.push_back({before_.name});
  progress(0);
}

StageLog::Stage::~Stage() {
  progress(total_work_);
  StageCost& cost = log_.stages_[index_];
  cost.wall_seconds = wall_seconds() - before_.wall_seconds;
  cost.cpu_seconds = cpu_seconds() - before_.cpu_seconds;
  cost.spilled_bytes = log_.scratch_.spilled_bytes() - before_.spilled_bytes;
  cost.written_bytes = log_.scratch_.written_bytes() - before_.written_bytes;
  cost.read_bytes = log_.scratch_.read_bytes() - before_.read_bytes;
  for (std::size_t i = 0; i < items_before_.size(); ++i) {
    if (log_.workers_.items_done(i) > items_before_[i]) ++cost.workers_busy;
  }
}

void StageLog::Stage::progress(std::uint64_t done) {
  if (!log_.progress_ || total_work_ == 0) return;
  const double fraction =
      std::min(1.0, static_cast<double>(done) / static_cast<double>(total_work_));
  const int percent = static_cast<int>(100 * fraction);
  if (percent == std::exchange(shown_percent_, percent)) return;
  log_.progress_(before_.name, fraction);
}

}  // namespace atlasgauge
