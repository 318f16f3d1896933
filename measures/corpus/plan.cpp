#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include "io/bytes.hpp"
#include "io/corpus/batch_scripts.hpp"
#include "io/corpus/corpus_job.hpp"
#include "io/corpus/find_models.hpp"
#include "io/corpus/manifest.hpp"
#include "io/cpu_limit.hpp"
#include "io/error.hpp"
#include "io/file/output_file.hpp"
#include "io/program_identity.hpp"
#include "measures/corpus/corpus.hpp"
#include "measures/corpus/corpus_progress.hpp"
#include "measures/corpus/probe_pool.hpp"
#include "measures/corpus/slices.hpp"

namespace atlasgauge {
namespace {

std::string absolute_path(const std::string& path) {
  std::error_code fault;
  std::filesystem::path absolute = std::filesystem::absolute(path, fault);
  if (!fault) absolute = std::filesystem::weakly_canonical(absolute, fault);
  if (fault) throw Error(ErrorKind::kInput, path, 0, fault.message());
  return absolute.string();
}

FoundModels models_in(const std::string& root, const CorpusPlanOptions& options) {
  FoundModels found = find_models({root, options.patterns, options.job});
  if (!found.paths.empty()) return found;
  throw Error(ErrorKind::kInput, options.models, 0,
              options.patterns.empty()
                  ? "it holds no model: no .obj, .ply, .drc, .gltf, .glb, .b3dm or tileset.json"
                  : "no file in it matches the patterns of --glob");
}

/// Gives each model its slice; returns how many there are.
std::uint64_t slice(std::vector<PlannedModel>& models, std::optional<std::uint64_t> wanted) {
  std::vector<double> seconds;
  seconds.reserve(models.size());
  for (const PlannedModel& model : models) seconds.push_back(model.seconds);
  const std::uint64_t slices =
      std::min<std::uint64_t>(wanted.value_or(usual_slices(seconds)), models.size());
  const std::vector<std::uint64_t> slice_of = balanced_slices(seconds, slices);
  for (std::size_t i = 0; i < models.size(); ++i) models[i].slice = slice_of[i];
  return slices;
}

BatchJob batch_of(const CorpusJob& job, std::uint64_t slices) {
  return {program_path(), job.folder(), job.logs_path(), slices};
}

void write_scripts(const CorpusJob& job, std::uint64_t slices) {
  const BatchJob batch = batch_of(job, slices);
  write_file(job.script_path("corpus"), corpus_script(batch));
  write_file(job.script_path("gather"), gather_script(batch));
}

std::string summary_of(const CorpusJob& job, const std::vector<PlannedModel>& models,
                       std::uint64_t slices) {
  double seconds = 0;
  std::uint64_t bytes = 0;
  for (const PlannedModel& model : models) {
    seconds += model.seconds;
    bytes += model.bytes;
  }
  const std::string corpus_sbatch = shell_word(job.script_path("corpus"));
  const std::string gather_sbatch = shell_word(job.script_path("gather"));
  const std::string folder = shell_word(job.folder());
  return fmt::format(
      "{} models, {}, about {:.0f} s of CPU, in {} slices\n"
      "here:   atlasgauge corpus run {} && atlasgauge corpus gather {}\n"
      "Slurm:  id=$(sbatch --parsable {})\n"
      "        sbatch --dependency=afterany:$id {}\n",
      models.size(), format_bytes(bytes), seconds, slices, folder, folder, corpus_sbatch,
      gather_sbatch);
}

}  // namespace

int plan_corpus(const CorpusPlanOptions& options) {
  const std::string root = absolute_path(options.models);
  const CorpusJob job(absolute_path(options.job));
  const FoundModels found = models_in(root, options);
  CorpusProgress progress(options.progress, false);
  for (const std::string& folder : found.unreadable) {
    progress.message("warning: " + folder + ": the folder cannot be searched; it is left out");
  }
  corpus_script(batch_of(job, 1));  // throws for a folder that no script can name
  job.make_folders();

  ManifestWriter manifest(job);
  std::vector<PlannedModel> models;
  const std::size_t jobs = options.jobs > 0 ? options.jobs : detect_cpu_limit().cpus;
  const ProbeWork work{{root, 0, options.arguments}, found.paths, jobs};
  const int signal = probe_models(work, [&](const ModelProbe& probe) {
    for (const InputFile& file : probe.inputs.files) manifest.add_input(file);
    models.push_back({0, probe.seconds, probe.inputs.bytes, probe.inputs.files.size(),
                      probe.inputs.hex, probe.path});
    progress.show(models.size(), found.paths.size());
  });
  if (signal != 0) return 128 + signal;
  progress.clear();

  const std::uint64_t slices = slice(models, options.slices);
  for (const PlannedModel& model : models) manifest.add_model(model);
  manifest.commit();
  job.write_settings({root, slices, options.arguments});
  write_scripts(job, slices);
  write_file("-", summary_of(job, models, slices));
  return 0;
}

}  // namespace atlasgauge
