#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/corpus/corpus_job.hpp"
#include "io/corpus/input_digest.hpp"
#include "io/file/output_file.hpp"
#include "io/tsv.hpp"

namespace atlasgauge {

/// A model of a corpus, as it was when the job was planned.
struct PlannedModel {
  std::uint64_t slice = 0;
  double seconds = 0;       ///< that measuring it takes, as estimated
  std::uint64_t bytes = 0;  ///< of all its files
  std::uint64_t files = 0;
  std::string digest;  ///< of its files, in 32 hexadecimal digits
  std::string path;    ///< from the root of the corpus
};

/// manifest.tsv: a line a model, in the order of their paths. inputs.tsv: lines of bytes, time of
/// modification in ns (of the system's clock; see InputFile) and path, for all files of the first
/// model, then of the second, and so on.
///
/// Writes both, the inputs as they become known, the models when all slices are.
class ManifestWriter {
 public:
  explicit ManifestWriter(const CorpusJob& job);

  void add_input(const InputFile& input);
  void add_model(const PlannedModel& model);
  /// Neither is there before.
  void commit();

 private:
  OutputFile models_;
  OutputFile inputs_;
};

/// Reads them back, model after model; throws Error(kInput) for what was not written so, and for
/// paths that lead out of the corpus.
class ManifestReader {
 public:
  explicit ManifestReader(const CorpusJob& job);

  std::optional<PlannedModel> next();
  /// The files of the model that next() returned last.
  const std::vector<InputFile>& inputs() const { return inputs_; }

 private:
  void read_inputs(std::uint64_t files);

  TsvReader models_;
  TsvReader input_lines_;
  std::vector<InputFile> inputs_;
};

}  // namespace atlasgauge
