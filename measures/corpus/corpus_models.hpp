#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "io/corpus/corpus_job.hpp"
#include "io/corpus/input_digest.hpp"
#include "io/corpus/manifest.hpp"
#include "io/process/stop_signals.hpp"
#include "measures/corpus/model_digests.hpp"

namespace atlasgauge {

/// A model with the files that its digest is of, the model itself first; none where they cannot be
/// listed.
struct CurrentModel {
  PlannedModel planned;
  std::vector<InputFile> inputs;

  bool is_there() const {
    return inputs.empty() || inputs.front().modified_ns != InputFile::kMissing;
  }
};

/// The models of a job one after the other, each with the digest of its files as they are now: that
/// of the manifest where they still have the sizes and times that they had, else made anew.
class CorpusModels {
 public:
  /// All outlive it. Throws Error(kResource) where the folder of the models is not there.
  CorpusModels(const CorpusJob& job, const CorpusSettings& settings, StopSignals& stop);

  /// The next of all, or of a slice; none after the last, or when a signal came.
  std::optional<CurrentModel> next(std::optional<std::uint64_t> slice = std::nullopt);

  /// Makes the digest anew, if need be. False when a signal came.
  bool bring_up_to_date(CurrentModel& model);
  /// Whether all files can be read again, and are what the digest is of. False when a signal came.
  bool is_still(const CurrentModel& model);

 private:
  const CorpusJob& job_;
  const CorpusSettings& settings_;
  StopSignals& stop_;
  ModelDigests digests_;
  ManifestReader manifest_;
};

}  // namespace atlasgauge
