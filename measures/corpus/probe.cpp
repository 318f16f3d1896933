#include <algorithm>
#include <array>
#include <string>

#include "io/corpus/corpus_models.hpp"
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
double seconds_for(const std::string& path, std::optional<std::uint32_t> lod) {
  constexpr double kStartSeconds = 0.02;
  const OpenParts open = [&](const std::string& input, Warnings& warnings) {
    return open_parts(input, {.lod = lod}, warnings);
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
    ModelProbe probe{model, 0, digest_model(options.root, model, options.lod)};
    probe.seconds = seconds_for(options.root + "/" + model, options.lod);
    write_file("-", probe_text(probe));
  }
  return 0;
}

}  // namespace atlasgauge
