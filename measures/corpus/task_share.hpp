#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "io/corpus/corpus_command.hpp"
#include "measures/corpus/model_run.hpp"

namespace atlasgauge {

/// What a task may use, and how many models share it.
struct TaskShare {
  std::uint64_t memory_bytes = 0;
  std::size_t threads = 1;
  std::size_t jobs = 1;
  std::string tmp_dir;

  /// What each of `models` side by side gets; all threads are in use.
  ModelShare of_one(std::size_t models) const;
};

/// As wished, or all that the cgroup, Slurm and the machine allow; by default a model a CPU, as far
/// as each then has half a GiB, in which most models of a corpus are measured without the disk.
/// Throws Error(kResource) where a model's share is too little for any.
TaskShare share_of_task(const CorpusRunOptions& options, std::size_t models);

}  // namespace atlasgauge
