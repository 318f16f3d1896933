#include "measures/corpus/corpus_rows.hpp"

#include <utility>

#include "io/corpus/model_metadata.hpp"
#include "measures/corpus/corpus_models.hpp"

namespace atlasgauge {

const char* CorpusRow::status() const {
  if (!result) return "missing";
  return result->measured ? "measured" : "failed";
}

CorpusRows::CorpusRows(const CorpusJob& job, StopSignals& stop, Warnings& warnings)
    : settings_(job.read_settings()), results_(job, settings_) {
  CorpusModels models(job, settings_, stop);
  while (const auto model = models.next()) {
    const PlannedModel& planned = model->planned;
    CorpusRow row{planned.path, planned.digest, results_.find(planned.digest)};
    row.has_metadata = metadata_of(settings_.root, row.path, warnings).has_value();
    rows_.push_back(std::move(row));
  }
}

std::optional<std::string> CorpusRows::report(const CorpusRow& row) const {
  if (!row.is_measured()) return std::nullopt;
  return results_.report(row.digest);
}

std::optional<std::string> CorpusRows::metadata(const CorpusRow& row) const {
  if (!row.has_metadata) return std::nullopt;
  Warnings told_before(nullptr);
  return metadata_of(settings_.root, row.path, told_before);
}

}  // namespace atlasgauge
