// The hard protocol is what may be done twice, and what may not:
//
// - A result is written when the process that measured the model has ended by itself, and the
//   model's files still are what their digest was made of (for a failure they are read again, as
//   it may be the disk's). Whatever ends this task before, leaves nothing, and the next run
//   measures the model again.
// - A model that fails by its own fault has a result that says so. One that was refused for lack of
//   memory or disk is tried once more when all others are done, alone, with everything that the
//   task has; one that was killed, or whose files changed meanwhile, up to twice. After that it has
//   no result, and is missing.
// - A model that brought the whole task down is known by the attempts that it began (AttemptLog),
//   and comes last when the task starts again.

#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "io/bytes.hpp"
#include "io/corpus/attempt_log.hpp"
#include "io/corpus/corpus_job.hpp"
#include "io/corpus/model_result.hpp"
#include "io/error.hpp"
#include "io/process/child_processes.hpp"
#include "io/process/stop_signals.hpp"
#include "io/program_identity.hpp"
#include "measures/corpus/corpus.hpp"
#include "measures/corpus/corpus_models.hpp"
#include "measures/corpus/corpus_progress.hpp"
#include "measures/corpus/model_run.hpp"
#include "measures/corpus/tally.hpp"
#include "measures/corpus/task_share.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kMostTries = 3;

/// A model to measure.
struct Task {
  CurrentModel model;
  std::size_t tries = 0;

  const std::string& path() const { return model.planned.path; }
  const std::string& digest() const { return model.planned.digest; }
};

std::string slice_name(const CorpusRunOptions& options, const CorpusSettings& settings) {
  if (!options.slice) return "all";
  if (*options.slice < settings.slices) return std::to_string(*options.slice);
  throw Error(ErrorKind::kUsage, fmt::format("there is no slice {}; the job has 0 to {}",
                                             *options.slice, settings.slices - 1));
}

class SliceRun {
 public:
  explicit SliceRun(const CorpusRunOptions& options)
      : options_(options),
        job_(options.job),
        settings_(job_.read_settings()),
        results_(job_, settings_),
        log_(job_, slice_name(options, settings_)),
        progress_(options.progress, options.quiet),
        models_(job_, settings_, stop_),
        children_(stop_) {}

  int run() {
    collect();
    total_ = waiting_.size();
    if (total_ > 0) {
      share_ = share_of_task(options_, total_);
      measure_waiting(share_.jobs);
      alone_ = true;
      waiting_ = std::exchange(again_, {});
      measure_waiting(1);
    }
    progress_.clear();
    if (stop_.taken() != 0) return 128 + stop_.taken();
    if (!options_.quiet) std::fputs(summary().c_str(), stdout);
    return tally_.missing > 0 ? 1 : 0;
  }

 private:
  /// The models without a result: those that were begun before last, and of others the one that
  /// takes longest first, so that none is left over at the end.
  void collect() {
    while (auto model = models_.next(options_.slice)) {
      if (results_.find(model->planned.digest)) {
        ++before_;
      } else {
        waiting_.push_back({std::move(*model)});
      }
    }
    const std::map<std::string, Attempts> attempts = read_attempts(job_);
    const auto begun = [&](const Task& task) {
      const auto found = attempts.find(task.digest());
      return found == attempts.end() ? 0 : found->second.begun;
    };
    std::ranges::stable_sort(waiting_, [&](const Task& a, const Task& b) {
      return std::tuple(begun(a), -a.model.planned.seconds) <
             std::tuple(begun(b), -b.model.planned.seconds);
    });
  }

  /// Works on all that wait, and on what is put among them meanwhile.
  void measure_waiting(std::size_t side_by_side) {
    const ModelShare share = share_.of_one(side_by_side);
    while (stop_.taken() == 0 && (next_ < waiting_.size() || children_.running() > 0)) {
      if (next_ < waiting_.size() && children_.running() < side_by_side) {
        begin(next_++, share);
      } else if (const std::optional<ChildEnd> end = children_.wait()) {
        settle(waiting_[end->tag], *end);
      }
    }
    next_ = 0;
  }

  void begin(std::size_t tag, const ModelShare& share) {
    Task& task = waiting_[tag];
    ++task.tries;
    if (!models_.bring_up_to_date(task.model)) return;
    if (!task.model.is_there()) return give_up(task, "its file is not there");
    log_.began(task.digest());
    const std::string path = settings_.root + "/" + task.path();
    children_.start(tag, measure_command(path, settings_.arguments, share));
  }

  void settle(Task& task, const ChildEnd& end) {
    ModelOutcome outcome = outcome_of(end, settings_.root);
    if (!is_as_it_was(task, outcome.outcome)) {
      outcome = {Outcome::kKilled, "its files changed, or could not be read again", {}};
    }
    switch (outcome.outcome) {
      case Outcome::kMeasured:
        keep(task, outcome, end.out);
        ++tally_.measured;
        return tell(fmt::format("measured {} ({:.1f} s, {})", task.path(), end.wall_seconds,
                                format_bytes(end.peak_resident_bytes)));
      case Outcome::kFailed:
        keep(task, outcome, "");
        ++tally_.failed;
        return tell("failed " + task.path() + ": " + outcome.reason);
      case Outcome::kRefused:
      case Outcome::kKilled:
        return give_up_or_put_off(task, outcome);
    }
  }

  /// A failure may come from a disk that did not answer: it counts when all can be read again.
  bool is_as_it_was(const Task& task, Outcome outcome) {
    if (outcome == Outcome::kFailed) return models_.is_still(task.model);
    return task.model.inputs.empty() || unchanged(task.model.inputs);
  }

  void keep(const Task& task, const ModelOutcome& outcome, const std::string& report) {
    results_.write(task.digest(),
                   {task.path(), "atlasgauge " + program_version(),
                    outcome.outcome == Outcome::kMeasured, outcome.reason, outcome.warnings},
                   report);
  }

  void give_up_or_put_off(Task& task, const ModelOutcome& outcome) {
    const bool refused = outcome.outcome == Outcome::kRefused;
    const bool had_all = alone_ || share_.jobs == 1;
    if (refused ? !had_all : task.tries < kMostTries) {
      if (!options_.quiet) progress_.message("put off " + task.path() + ": " + outcome.reason);
      (alone_ ? waiting_ : again_).push_back(task);
      return;
    }
    give_up(task,
            refused ? outcome.reason : fmt::format("{}, {} times", outcome.reason, task.tries));
  }

  void give_up(const Task& task, const std::string& reason) {
    log_.came_to_nothing(task.digest(), reason);
    ++tally_.missing;
    const std::string line = "missing " + task.path() + ": " + reason;
    if (options_.quiet) progress_.message(line);
    tell(line);
  }

  /// Of a model that is counted.
  void tell(const std::string& line) { progress_.model(line, tally_.models(), total_); }

  std::string summary() const {
    return fmt::format("{}; {} had a result already\n", tally_.text(), before_);
  }

  const CorpusRunOptions& options_;
  const CorpusJob job_;
  const CorpusSettings settings_;
  const ResultStore results_;
  AttemptLog log_;
  CorpusProgress progress_;
  StopSignals stop_;
  CorpusModels models_;
  ChildProcesses children_;
  TaskShare share_;
  std::vector<Task> waiting_;
  std::vector<Task> again_;  ///< to be measured alone, when all others are done
  std::size_t next_ = 0;     ///< in waiting_
  bool alone_ = false;
  std::size_t before_ = 0;  ///< had a result already
  Tally tally_;             ///< of the others
  std::size_t total_ = 0;   ///< of those
};

}  // namespace

int run_corpus(const CorpusRunOptions& options) {
  // Who reads the messages may go; the results are files.
  std::signal(SIGPIPE, SIG_IGN);
  return SliceRun(options).run();
}

}  // namespace atlasgauge
