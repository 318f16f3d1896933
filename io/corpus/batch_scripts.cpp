#include "io/corpus/batch_scripts.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

/// A value in an #SBATCH line, where quotes and backslashes are as in a shell, but % begins a
/// pattern.
std::string directive_path(const std::string& folder, const std::string& name) {
  if (folder.find('\n') != std::string::npos) {
    throw Error(ErrorKind::kUsage, folder, 0,
                "a batch script cannot name a folder with a line end; give another one as --out");
  }
  std::string quoted = "\"";
  for (const char c : folder) {
    if (c == '"' || c == '\\') quoted += '\\';
    if (c == '%') quoted += '%';
    quoted += c;
  }
  return quoted + "/" + name + "\"";
}

constexpr std::string_view kCorpus = R"(#!/bin/bash
#SBATCH --job-name=atlasgauge
#SBATCH --array=0-{last}
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=2
#SBATCH --mem=2G
#SBATCH --requeue
#SBATCH --open-mode=append
#SBATCH --output={output}
# A task measures one slice of a corpus. Options of sbatch on the command line win over those above:
#   sbatch --partition=P --account=A --time=8:00:00 --mem=8G {script}
echo "task $SLURM_ARRAY_TASK_ID on ${{SLURMD_NODENAME:-$(hostname)}}, restart ${{SLURM_RESTART_COUNT:-0}}"
{program} corpus run {folder} --slice "$SLURM_ARRAY_TASK_ID"
rc=$?
# Killed, as by the system when memory ran out: once more, at most twice. Not so when the job is
# cancelled or reaches its time limit (143), and a bad model is no failure of the task.
if [ "$rc" -eq 137 ] && [ "${{SLURM_RESTART_COUNT:-0}}" -lt 2 ]; then
  scontrol requeue "$SLURM_JOB_ID"
  sleep 60  # until the controller ends this run of the task
fi
exit "$rc"
)";

constexpr std::string_view kGather = R"(#!/bin/bash
#SBATCH --job-name=atlasgauge-gather
#SBATCH --ntasks=1
#SBATCH --mem=1G
#SBATCH --open-mode=append
#SBATCH --output={output}
# To be submitted with --dependency=afterany:ID, ID being that of the array. It fails when a model is
# missing, and names it; "corpus status" says what to submit again.
exec {program} corpus gather {folder}
)";

}  // namespace

std::string shell_word(const std::string& text) {
  constexpr std::string_view kPlain =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,@%";
  if (!text.empty() && text.find_first_not_of(kPlain) == std::string::npos) return text;
  std::string word = "'";
  for (const char c : text) c == '\'' ? word += "'\\''" : word += c;
  return word + "'";
}

std::string corpus_script(const BatchJob& job) {
  return fmt::format(kCorpus, fmt::arg("last", job.slices - 1),
                     fmt::arg("output", directive_path(job.logs_folder, "%A_%a.log")),
                     fmt::arg("script", shell_word(job.folder + "/corpus.sbatch")),
                     fmt::arg("program", shell_word(job.program)),
                     fmt::arg("folder", shell_word(job.folder)));
}

std::string gather_script(const BatchJob& job) {
  return fmt::format(kGather, fmt::arg("output", directive_path(job.logs_folder, "gather.log")),
                     fmt::arg("program", shell_word(job.program)),
                     fmt::arg("folder", shell_word(job.folder)));
}

std::string array_text(const std::vector<std::uint64_t>& slices) {
  std::string text;
  for (std::size_t i = 0; i < slices.size();) {
    std::size_t end = i + 1;
    while (end < slices.size() && slices[end] == slices[end - 1] + 1) ++end;
    if (!text.empty()) text += ',';
    text += std::to_string(slices[i]);
    if (end - i > 1) text += '-' + std::to_string(slices[end - 1]);
    i = end;
  }
  return text;
}

}  // namespace atlasgauge
