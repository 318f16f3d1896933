#include "measures/corpus/corpus_models.hpp"

#include <filesystem>
#include <system_error>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {

CorpusModels::CorpusModels(const CorpusJob& job, const CorpusSettings& settings, StopSignals& stop)
    : job_(job), settings_(settings), stop_(stop), digests_(settings, stop), manifest_(job) {
  std::error_code fault;
  if (std::filesystem::is_directory(settings.root, fault)) return;
  throw Error(ErrorKind::kResource, settings.root, 0,
              "the folder of the models is not there; mount it on this machine, or plan the job "
              "anew where it lies now");
}

std::optional<CurrentModel> CorpusModels::next(std::optional<std::uint64_t> slice) {
  std::optional<PlannedModel> planned = manifest_.next();
  while (slice && planned && planned->slice != *slice) planned = manifest_.next();
  if (!planned || stop_.take()) return std::nullopt;
  CurrentModel model{std::move(*planned), manifest_.inputs()};
  const std::string path = settings_.root + "/" + model.planned.path;
  if (!model.inputs.empty() && model.inputs.front().path != path) {
    throw Error(ErrorKind::kInput, job_.folder(), 0,
                "its files are of different plans; make the job anew with corpus plan");
  }
  if (!bring_up_to_date(model)) return std::nullopt;
  return model;
}

bool CorpusModels::bring_up_to_date(CurrentModel& model) {
  if (unchanged(model.inputs)) return true;
  std::optional<InputDigest> now = digests_.of(model.planned.path);
  if (!now) return false;
  model.planned.digest = std::move(now->hex);
  model.planned.bytes = now->bytes;
  model.planned.files = now->files.size();
  model.inputs = std::move(now->files);
  return true;
}

bool CorpusModels::is_still(const CurrentModel& model) {
  const std::optional<InputDigest> now = digests_.of(model.planned.path);
  return now && now->hex == model.planned.digest;
}

}  // namespace atlasgauge
