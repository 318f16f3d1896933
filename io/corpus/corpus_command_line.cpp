#include "io/corpus/corpus_command_line.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "io/bytes.hpp"
#include "io/command_line.hpp"
#include "io/error.hpp"
#include "io/progress_option.hpp"

namespace atlasgauge {
namespace {

/// Every command's options as given, until it is known which was meant.
struct Texts {
  CorpusPlanOptions plan;
  CorpusProbeOptions probe;
  CorpusRunOptions run;
  CorpusStatusOptions status;
  CorpusGatherOptions gather;
  std::string texture_size, lod, memory, progress = "auto";
  bool strict = false, texmetro_seams = false;
};

CLI::App* describe_plan(CLI::App& app, Texts& texts) {
  CLI::App* const plan = app.add_subcommand(
      "plan", "look for models in a folder, and make the folder of a job that measures them");
  plan->add_option("DIR", texts.plan.models, "the folder of the models")->required();
  plan->add_option("--out", texts.plan.job, "the folder to make for the job")
      ->required()
      ->type_name("JOB");
  plan->add_option("--tasks", texts.plan.slices,
                   "slices to cut it into (default: of about a minute each, at most 1000)")
      ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{1} << 32))
      ->type_name("N");
  plan->add_option("--glob", texts.plan.patterns,
                   "a pattern for the names of models, or for their paths below DIR if it holds a "
                   "slash; may be given again (default: all files of formats that can be measured)")
      ->allow_extra_args(false)
      ->type_name("PATTERN");
  plan->add_option("-t,--texture-size", texts.texture_size, "as of measure")->type_name("WxH");
  plan->add_option("--lod", texts.lod, "as of measure")->type_name("N");
  plan->add_flag("--strict", texts.strict, "as of measure");
  plan->add_flag("--texmetro-seams", texts.texmetro_seams, "as of measure");
  plan->add_option("--jobs", texts.plan.jobs, "models to look at side by side (default: the CPUs)")
      ->type_name("K");
  add_progress_option(*plan, texts.progress);
  return plan;
}

CLI::App* describe_probe(CLI::App& app, Texts& texts) {
  CLI::App* const probe = app.add_subcommand("probe", "what plan asks about some models");
  probe->group("");
  probe->add_option("ROOT", texts.probe.root)->required();
  probe->add_option("MODEL", texts.probe.models);
  probe->add_option("--lod", texts.probe.lod);
  probe->add_flag("--digests-only", texts.probe.digests_only);
  return probe;
}

CLI::App* describe_run(CLI::App& app, Texts& texts) {
  CLI::App* const run = app.add_subcommand(
      "run",
      "measure a slice of a job, each model in a process of its own; what has a result is "
      "passed over");
  run->add_option("JOB", texts.run.job, "the folder of the job")->required();
  run->add_option("--slice", texts.run.slice, "the slice (default: everything)")->type_name("I");
  run->add_option("--jobs", texts.run.jobs,
                  "models to measure side by side (default: as many as CPUs and memory allow)")
      ->type_name("K");
  run->add_option("--memory", texts.memory,
                  "memory for all of them together (default: 0.8 of what the cgroup, Slurm or the "
                  "machine allow)")
      ->type_name("BYTES");
  run->add_option("--threads", texts.run.threads,
                  "threads for all of them together (default: the CPUs)")
      ->type_name("N");
  run->add_option("--tmp-dir", texts.run.tmp_dir,
                  "directory for scratch (default: TMPDIR, /var/tmp)")
      ->type_name("DIR");
  run->add_flag("-q,--quiet", texts.run.quiet, "print errors only");
  add_progress_option(*run, texts.progress);
  return run;
}

CLI::App* describe_status(CLI::App& app, Texts& texts) {
  CLI::App* const status = app.add_subcommand(
      "status",
      "say what is measured, what failed and what is missing, and how to go on; exit 1 "
      "while anything is missing");
  status->add_option("JOB", texts.status.job, "the folder of the job")->required();
  return status;
}

CLI::App* describe_gather(CLI::App& app, Texts& texts) {
  CLI::App* const gather = app.add_subcommand(
      "gather",
      "make one table of all results, JOB/corpus.csv and JOB/corpus.jsonl; exit 1 if any "
      "is missing");
  gather->add_option("JOB", texts.gather.job, "the folder of the job")->required();
  gather
      ->add_option("--reports", texts.gather.reports,
                   "also write each model's report, as DIR/PATH.json; with the folder of the "
                   "corpus, beside the model")
      ->type_name("DIR");
  return gather;
}

/// Checked by the parser of `measure` itself.
std::vector<std::string> measure_arguments(const Texts& texts) {
  std::vector<std::string> arguments;
  const auto add = [&](const char* name, const std::string& value) {
    if (!value.empty()) arguments.insert(arguments.end(), {name, value});
  };
  add("-t", texts.texture_size);
  add("--lod", texts.lod);
  if (texts.strict) arguments.emplace_back("--strict");
  if (texts.texmetro_seams) arguments.emplace_back("--texmetro-seams");
  std::vector<std::string> line = arguments;
  line.emplace_back("model.obj");
  parse_command_line(line);
  return arguments;
}

CorpusPlanOptions checked_plan(Texts& texts) {
  texts.plan.arguments = measure_arguments(texts);
  texts.plan.progress = progress_mode(texts.progress);
  return texts.plan;
}

CorpusRunOptions checked_run(Texts& texts) {
  if (!texts.memory.empty()) texts.run.memory_bytes = parse_bytes(texts.memory);
  texts.run.progress = progress_mode(texts.progress);
  return texts.run;
}

}  // namespace

std::variant<CorpusCommand, std::string> parse_corpus_command(std::vector<std::string> arguments) {
  Texts texts;
  CLI::App app(
      "Measures all models of a folder, in slices, on one machine or many.\n"
      "Usage: atlasgauge corpus plan DIR --out JOB, then corpus run|status|gather JOB");
  const CLI::App* const plan = describe_plan(app, texts);
  const CLI::App* const probe = describe_probe(app, texts);
  const CLI::App* const run = describe_run(app, texts);
  const CLI::App* const status = describe_status(app, texts);
  const CLI::App* const gather = describe_gather(app, texts);
  app.require_subcommand(1);
  std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them last first
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    return app.help();
  } catch (const CLI::ParseError& error) {
    throw Error(ErrorKind::kUsage, std::string(error.what()) + "; see atlasgauge corpus --help");
  }
  if (plan->parsed()) return checked_plan(texts);
  if (probe->parsed()) return texts.probe;
  if (run->parsed()) return checked_run(texts);
  if (status->parsed()) return texts.status;
  if (gather->parsed()) return texts.gather;
  throw Error(ErrorKind::kInternal, "a command of corpus is described, but not handled");
}

}  // namespace atlasgauge
