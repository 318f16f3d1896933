#pragma once

#include "io/corpus/corpus_command.hpp"

namespace atlasgauge {

/// The commands of `corpus`. Each returns the exit code of the program: 0, 1 if a model is
/// missing, or 128 + n when signal n ended it; and throws Error for all that ends it sooner.
/// Results go to standard output, remarks to standard error.

/// Looks for models, estimates what each costs, and makes the folder of a job that measures them.
int plan_corpus(const CorpusPlanOptions& options);

/// What plan_corpus() asks a child process: prints a probe of each model (io/corpus/model_probe).
int probe_corpus(const CorpusProbeOptions& options);

/// Measures the models of a slice that have no result yet, each in a process of its own.
int run_corpus(const CorpusRunOptions& options);

/// Prints what is measured, what failed, what is missing, and how to go on.
int show_corpus(const CorpusStatusOptions& options);

/// Makes one table of all results, as CSV and as JSON Lines.
int gather_corpus(const CorpusGatherOptions& options);

}  // namespace atlasgauge
