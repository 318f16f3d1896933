#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "io/progress_bar.hpp"

namespace atlasgauge {

/// `corpus plan`: makes the folder of a job.
struct CorpusPlanOptions {
  std::string models;                   ///< folder of the corpus
  std::string job;                      ///< folder to make
  std::optional<std::uint64_t> slices;  ///< none: of a minute each, at most a thousand
  std::vector<std::string> patterns;    ///< of the models; none: all that can be measured
  std::vector<std::string> arguments;   ///< of `measure`: those that change a report
  std::size_t jobs = 0;                 ///< models looked at side by side; 0: one a CPU
  ProgressMode progress = ProgressMode::kAuto;
};

/// `corpus probe`: what `plan` asks a child process about some models.
struct CorpusProbeOptions {
  std::string root;
  std::vector<std::string> models;  ///< from the root
  std::optional<std::uint32_t> lod;
  bool digests_only = false;
};

/// `corpus run`: measures a slice.
struct CorpusRunOptions {
  std::string job;
  std::optional<std::uint64_t> slice;         ///< none: all
  std::size_t jobs = 0;                       ///< models measured side by side; 0: as many as fit
  std::optional<std::uint64_t> memory_bytes;  ///< for all of them together
  std::size_t threads = 0;                    ///< for all of them together; 0: one a CPU
  std::string tmp_dir;                        ///< empty: the default of `measure`
  ProgressMode progress = ProgressMode::kAuto;
  bool quiet = false;
};

/// `corpus status`: says what is done.
struct CorpusStatusOptions {
  std::string job;
};

/// `corpus gather`: makes one table of all results.
struct CorpusGatherOptions {
  std::string job;
  std::optional<std::string> reports;  ///< folder for the report of each model
};

using CorpusCommand = std::variant<CorpusPlanOptions, CorpusProbeOptions, CorpusRunOptions,
                                   CorpusStatusOptions, CorpusGatherOptions>;

}  // namespace atlasgauge
