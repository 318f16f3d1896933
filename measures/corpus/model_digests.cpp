#include "measures/corpus/model_digests.hpp"

#include <algorithm>
#include <utility>

#include "io/corpus/model_probe.hpp"

namespace atlasgauge {

ModelDigests::ModelDigests(const CorpusSettings& settings, StopSignals& stop)
    : settings_(settings), children_(stop) {}

std::optional<InputDigest> ModelDigests::of(const std::string& path) {
  children_.start(0, probe_command(settings_, {path}, true));
  const std::optional<ChildEnd> end = children_.wait();
  if (!end) return std::nullopt;
  std::vector<ModelProbe> probes = read_probes(end->out);
  if (probes.size() != 1) return digest_from_outside(settings_.root, path);
  return std::move(probes.front().inputs);
}

ChildCommand probe_command(const CorpusSettings& settings, const std::vector<std::string>& models,
                           bool digests_only) {
  ChildCommand command;
  std::vector<std::string>& words = command.arguments;
  words = {"/proc/self/exe", "corpus", "probe"};
  if (digests_only) words.emplace_back("--digests-only");
  // Of the arguments that change a report, the one that changes which files are read.
  const auto lod = std::ranges::find(settings.arguments, "--lod");
  if (lod != settings.arguments.end()) words.insert(words.end(), lod, lod + 2);
  words.insert(words.end(), {"--", settings.root});
  words.insert(words.end(), models.begin(), models.end());
  return command;
}

InputDigest digest_from_outside(const std::string& root, const std::string& path) {
  InputDigest digest = digest_inputs(root, {root + "/" + path});
  digest.files.clear();
  return digest;
}

}  // namespace atlasgauge
