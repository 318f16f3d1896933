#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/corpus/corpus_job.hpp"
#include "io/corpus/input_digest.hpp"
#include "io/process/child_processes.hpp"
#include "io/process/stop_signals.hpp"

namespace atlasgauge {

/// Digests models as they lie on the disk now, each in a child process: what a model does to its
/// reader, it does not do to the job.
class ModelDigests {
 public:
  /// Both outlive it.
  ModelDigests(const CorpusSettings& settings, StopSignals& stop);

  /// `path` is from the root. Nothing when a signal came.
  std::optional<InputDigest> of(const std::string& path);

 private:
  const CorpusSettings& settings_;
  ChildProcesses children_;
};

/// The command that probes models: see probe_corpus().
ChildCommand probe_command(const CorpusSettings& settings, const std::vector<std::string>& models,
                           bool digests_only);

/// What can be said of a model that brought such a process down: a digest of its own file alone, of
/// no list of files, so that it is never trusted, but made anew each time.
InputDigest digest_from_outside(const std::string& root, const std::string& path);

}  // namespace atlasgauge
