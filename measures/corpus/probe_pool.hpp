#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "io/corpus/corpus_job.hpp"
#include "io/corpus/model_probe.hpp"

namespace atlasgauge {

/// What to probe, and how.
struct ProbeWork {
  CorpusSettings settings;
  std::vector<std::string> models;  ///< paths from the root
  std::size_t jobs = 1;             ///< child processes side by side
};

/// Probes all models, many a child process, and calls take() for each in their order; a model that
/// brings its process down is taken by what can be said without reading into it. Returns the signal
/// that ended it, or 0.
int probe_models(const ProbeWork& work, const std::function<void(const ModelProbe&)>& take);

}  // namespace atlasgauge
