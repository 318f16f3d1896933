#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/corpus/corpus_job.hpp"
#include "io/corpus/input_digest.hpp"
#include "io/corpus/manifest.hpp"

namespace atlasgauge {

/// The digest of all that a model's numbers depend on, as it lies on the disk now. `path` is from
/// the root; `lod` as given to `measure`.
InputDigest digest_model(const std::string& root, const std::string& path,
                         std::optional<std::uint32_t> lod);
InputDigest digest_model(const CorpusSettings& settings, const std::string& path);

/// A model with the files that its digest is of.
struct CurrentModel {
  PlannedModel planned;
  std::vector<InputFile> inputs;
};

/// Makes the digest anew, where the files do not have the sizes and times any more that they had.
void bring_up_to_date(const CorpusSettings& settings, CurrentModel& model);

/// The models of a job one after the other, each with the digest of its files as they are now.
class CorpusModels {
 public:
  CorpusModels(const CorpusJob& job, const CorpusSettings& settings);

  /// The next of all, or of a slice; none after the last.
  std::optional<CurrentModel> next(std::optional<std::uint64_t> slice = std::nullopt);

 private:
  const CorpusSettings& settings_;
  ManifestReader manifest_;
};

}  // namespace atlasgauge
