#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace atlasgauge {

/// What the scripts of a job name. Paths are absolute.
struct BatchJob {
  std::string program;
  std::string folder;       ///< of the job
  std::string logs_folder;  ///< in it
  std::uint64_t slices = 1;
};

/// A word that a shell takes as `text`.
std::string shell_word(const std::string& text);

/// For sbatch: an array with a task a slice. A task that is killed (the system ran out of memory,
/// somebody sent SIGKILL) puts itself into the queue again, at most twice; one that is cancelled or
/// reaches its time limit does not. Plain: a site's partition, account and time limit are added on
/// the command line of sbatch, which wins over what is written here. Throws Error(kUsage) for a
/// folder whose name has a line end.
std::string corpus_script(const BatchJob& job);

/// For sbatch: gathers, after the array.
std::string gather_script(const BatchJob& job);

/// Task numbers for sbatch --array: "3,7-9". `slices` are sorted.
std::string array_text(const std::vector<std::uint64_t>& slices);

}  // namespace atlasgauge
