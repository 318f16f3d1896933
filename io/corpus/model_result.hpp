#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "io/corpus/corpus_job.hpp"
#include "io/warning_totals.hpp"

namespace atlasgauge {

/// What became of a model that was measured to the end, or that cannot be measured.
struct ModelResult {
  std::string model;      ///< its path from the root of the corpus
  std::string program;    ///< name and version of what measured it
  bool measured = false;  ///< false: failed, by a fault of the model
  std::string reason;     ///< of a failure
  WarningTotals warnings;
};

/// The results of a job: for each model at most one, a file named by the digest of the model's
/// inputs, the identity of the program and of its module for images, and the arguments that change
/// a report. So a result is found again if, and only if, none of these changed. A file is there
/// whole or not at all, and tasks that measure a model at the same time replace it by the same
/// bytes.
///
/// Its first line is a JSON object with all but the report, and the report's size, so that a file
/// that was cut is no result; the report follows, as measured.
class ResultStore {
 public:
  ResultStore(const CorpusJob& job, const CorpusSettings& settings);

  /// Nothing where there is none, or what there is was not written so.
  std::optional<ModelResult> find(const std::string& digest) const;
  /// Of a result that find() gave. Throws Error(kInput) if it went away.
  std::string report(const std::string& digest) const;

  /// On disk when it returns. Throws Error(kResource).
  void write(const std::string& digest, const ModelResult& result, std::string_view report) const;

 private:
  std::string path_of(const std::string& digest) const;

  std::string folder_;
  std::string suffix_;
};

}  // namespace atlasgauge
