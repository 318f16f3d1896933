#include "io/corpus/corpus_models.hpp"

#include <utility>

#include "io/command_line.hpp"
#include "io/corpus/input_files.hpp"

namespace atlasgauge {
namespace {

std::optional<std::uint32_t> lod_of(std::vector<std::string> arguments) {
  arguments.emplace_back("model");
  return parse_command_line(arguments).options.lod;
}

}  // namespace

InputDigest digest_model(const std::string& root, const std::string& path,
                         std::optional<std::uint32_t> lod) {
  return digest_inputs(root, list_model_inputs(root + "/" + path, {.lod = lod}).files);
}

InputDigest digest_model(const CorpusSettings& settings, const std::string& path) {
  return digest_model(settings.root, path, lod_of(settings.arguments));
}

void bring_up_to_date(const CorpusSettings& settings, CurrentModel& model) {
  if (unchanged(model.inputs)) return;
  InputDigest now = digest_model(settings, model.planned.path);
  model.planned.digest = std::move(now.hex);
  model.planned.bytes = now.bytes;
  model.planned.files = now.files.size();
  model.inputs = std::move(now.files);
}

CorpusModels::CorpusModels(const CorpusJob& job, const CorpusSettings& settings)
    : settings_(settings), manifest_(job) {}

std::optional<CurrentModel> CorpusModels::next(std::optional<std::uint64_t> slice) {
  std::optional<PlannedModel> planned = manifest_.next();
  while (slice && planned && planned->slice != *slice) planned = manifest_.next();
  if (!planned) return std::nullopt;
  CurrentModel model{std::move(*planned), manifest_.inputs()};
  bring_up_to_date(settings_, model);
  return model;
}

}  // namespace atlasgauge
