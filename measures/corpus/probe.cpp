#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "io/corpus/input_digest.hpp"
#include "io/corpus/input_files.hpp"
#include "io/corpus/model_probe.hpp"
#include "io/error.hpp"
#include "io/file/output_file.hpp"
#include "io/image/image_reader.hpp"
#include "io/open_parts.hpp"
#include "measures/corpus/corpus.hpp"
#include "stream/estimate.hpp"
#include "stream/memory_plan.hpp"

namespace atlasgauge {
namespace {

/// As much JSON as a run may hold that has all memory of the world, so that no file is overlooked
/// that it would read.
constexpr std::uint64_t kJsonBytes = std::uint64_t{128} << 20;

PartOptions part_options(const CorpusProbeOptions& options) {
  return {.lod = options.lod, .json_bytes = kJsonBytes};
}

/// Slices must not depend on the machine that plans them.
MemoryPlan plan_of_a_task() {
  constexpr std::uint64_t kTaskBytes = std::uint64_t{2} << 30;
  constexpr std::size_t kTaskCpus = 2;
  MemoryWishes wishes;
  wishes.limit_bytes = kTaskBytes;
  return plan_memory(wishes, kTaskCpus);
}

/// CPU time, since models are measured side by side. What cannot be estimated cannot be measured
/// either, and does not take long.
double seconds_for(const std::string& path, const PartOptions& options) {
  constexpr double kStartSeconds = 0.02;
  const OpenParts open = [&](const std::string& input, Warnings& warnings) {
    return open_parts(input, options, warnings);
  };
  try {
    const ModelGuess guess = guess_model(std::array{path}, {read_image_header, open});
    return kStartSeconds + estimate_cost(guess, plan_of_a_task()).cpu_seconds;
  } catch (const Error&) {
    return kStartSeconds;
  }
}

}  // namespace

int probe_corpus(const CorpusProbeOptions& options) {
  for (const std::string& model : options.models) {
    const std::string path = options.root + "/" + model;
    ModelProbe probe{model, 0, {}};
    probe.inputs =
        digest_inputs(options.root, list_model_inputs(path, part_options(options)).files);
    if (!options.digests_only) probe.seconds = seconds_for(path, part_options(options));
    write_file("-", probe_text(probe));
  }
  return 0;
}

}  // namespace atlasgauge
