#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace atlasgauge {

/// What all models of a job are measured by.
struct CorpusSettings {
  std::string root;                    ///< folder of the models, absolute
  std::uint64_t slices = 0;            ///< of the manifest
  std::vector<std::string> arguments;  ///< of the command line: those that change a report
};

/// The folder of a job, and where things lie in it:
///
///   job.tsv         its settings
///   manifest.tsv    a line a model: see manifest.hpp
///   inputs.tsv      the files that each depends on
///   corpus.sbatch   what a task of a Slurm job array runs; gather.sbatch: what follows it
///   results/        a file a model: see model_result.hpp
///   attempts/       what was begun, and what became of it: see attempt_log.hpp
///   logs/           of Slurm's tasks
///   corpus.csv, corpus.jsonl   the table of all, once gathered
class CorpusJob {
 public:
  explicit CorpusJob(std::string folder) : folder_(std::move(folder)) {}

  const std::string& folder() const { return folder_; }
  std::string manifest_path() const { return in_folder("manifest.tsv"); }
  std::string inputs_path() const { return in_folder("inputs.tsv"); }
  std::string results_path() const { return in_folder("results"); }
  std::string attempts_path() const { return in_folder("attempts"); }
  std::string logs_path() const { return in_folder("logs"); }
  std::string table_path(const std::string& suffix) const { return in_folder("corpus" + suffix); }
  std::string script_path(const std::string& name) const { return in_folder(name + ".sbatch"); }

  /// Makes the folder and those in it, where they are not there yet. Throws Error(kResource).
  void make_folders() const;

  /// Throws Error(kResource).
  void write_settings(const CorpusSettings& settings) const;
  /// Throws Error(kInput) where the folder holds no job.
  CorpusSettings read_settings() const;

 private:
  std::string settings_path() const { return in_folder("job.tsv"); }
  std::string in_folder(const std::string& name) const { return folder_ + "/" + name; }

  std::string folder_;
};

}  // namespace atlasgauge
