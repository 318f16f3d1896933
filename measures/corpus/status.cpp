#include <fmt/format.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "io/corpus/attempt_log.hpp"
#include "io/corpus/batch_scripts.hpp"
#include "io/corpus/corpus_job.hpp"
#include "io/corpus/model_result.hpp"
#include "io/file/output_file.hpp"
#include "measures/corpus/corpus.hpp"
#include "measures/corpus/corpus_models.hpp"
#include "measures/corpus/tally.hpp"

namespace atlasgauge {
namespace {

/// What a missing model is told with: the last attempt that had a reason, or that there was one.
std::string missing_line(const PlannedModel& model, const Attempts& attempts) {
  std::string why = attempts.reason;
  if (why.empty() && attempts.begun > 0) {
    why = fmt::format("begun {} times, not ended", attempts.begun);
  }
  if (why.empty()) why = "not begun";
  return fmt::format("missing  {} (slice {}): {}\n", model.path, model.slice, why);
}

/// How to measure the slices that have models missing.
std::string way_on(const CorpusJob& job, const std::set<std::uint64_t>& slices) {
  const std::vector<std::uint64_t> sorted(slices.begin(), slices.end());
  return fmt::format("sbatch --array={} {}\n", array_text(sorted),
                     shell_word(job.script_path("corpus")));
}

}  // namespace

int show_corpus(const CorpusStatusOptions& options) {
  const CorpusJob job(options.job);
  const CorpusSettings settings = job.read_settings();
  const ResultStore results(job, settings);
  std::map<std::string, Attempts> attempts = read_attempts(job);
  Tally tally;
  std::set<std::uint64_t> slices;
  std::string lines;
  StopSignals stop;
  CorpusModels models(job, settings, stop);
  while (const auto current = models.next()) {
    const PlannedModel& model = current->planned;
    const auto result = results.find(model.digest);
    tally.add(result);
    if (!result) {
      slices.insert(model.slice);
      lines += missing_line(model, attempts[model.digest]);
    } else if (!result->measured) {
      lines += fmt::format("failed   {}: {}\n", model.path, result->reason);
    }
  }
  if (stop.taken() != 0) return 128 + stop.taken();
  write_file("-", fmt::format("{} models in {} slices: {}\n", tally.models(), settings.slices,
                              tally.text()) +
                      lines + (slices.empty() ? "" : way_on(job, slices)));
  return tally.missing > 0 ? 1 : 0;
}

}  // namespace atlasgauge
