#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/corpus/corpus_job.hpp"
#include "io/corpus/model_result.hpp"
#include "io/process/stop_signals.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// What is known of a model, as it was when gathering began: what ends meanwhile is for the next
/// time.
struct CorpusRow {
  std::string path;
  std::string digest;
  std::optional<ModelResult> result;  ///< none: missing
  bool has_metadata = false;

  bool is_measured() const { return result && result->measured; }
  const char* status() const;
};

/// The models of a job in the order of the manifest. Reports and metadata, which are long, are read
/// again each time.
class CorpusRows {
 public:
  /// Warns about metadata that cannot be read. Ends before all are there when a signal comes.
  CorpusRows(const CorpusJob& job, StopSignals& stop, Warnings& warnings);

  const std::vector<CorpusRow>& all() const { return rows_; }
  /// The text of a report; none where the model is not measured.
  std::optional<std::string> report(const CorpusRow& row) const;
  /// The text of a metadata.json.
  std::optional<std::string> metadata(const CorpusRow& row) const;

 private:
  CorpusSettings settings_;
  ResultStore results_;
  std::vector<CorpusRow> rows_;
};

}  // namespace atlasgauge
