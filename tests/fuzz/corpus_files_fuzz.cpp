#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "io/corpus/attempt_log.hpp"
#include "io/corpus/corpus_job.hpp"
#include "io/corpus/manifest.hpp"
#include "io/corpus/model_metadata.hpp"
#include "io/corpus/model_probe.hpp"
#include "io/corpus/model_result.hpp"
#include "io/error.hpp"
#include "io/json/minified_json.hpp"
#include "io/process/message_tail.hpp"
#include "io/tsv.hpp"
#include "io/warning_totals.hpp"
#include "tests/fuzz/fuzz.hpp"
#include "tests/support/temp_dir.hpp"

// Whatever lies in the folder of a job or beside a model, is read, passed over or an input error
// that names its file, and never leads out of the corpus.
namespace atlasgauge {
namespace {

const std::string kDigest(32, 'a');

/// One folder for all inputs: making one a time would take longer than reading.
const TempDir& folder() {
  static const TempDir dir;
  return dir;
}

CorpusJob job() {
  return CorpusJob(folder().path().string());
}

template <class Action>
void may_refuse(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    fuzz::require(error.kind() == ErrorKind::kInput, error.what());
    fuzz::require(std::string(error.what()).starts_with(folder().path().string()),
                  "the error names the file");
  }
}

void read_manifest(const std::string& models, const std::string& inputs) {
  folder().write("manifest.tsv", models);
  folder().write("inputs.tsv", inputs);
  may_refuse([] {
    ManifestReader reader(job());
    while (const auto model = reader.next()) {
      fuzz::require(reader.inputs().size() == model->files, "a model has its files");
      fuzz::require(("/" + model->path + "/").find("/../") == std::string::npos,
                    "a path stays below the root");
    }
  });
}

void read_settings(const std::string& text) {
  folder().write("job.tsv", text);
  may_refuse([] { job().read_settings(); });
}

void read_result(const std::string& text) {
  const ResultStore store(job(), {});
  static const bool made = [&] {
    job().make_folders();
    store.write(kDigest, {}, "");
    return true;
  }();
  fuzz::require(made, "there is a result");
  for (const auto& entry : std::filesystem::directory_iterator(job().results_path() + "/aa")) {
    std::ofstream(entry.path(), std::ios::binary) << text;
  }
  if (store.find(kDigest)) store.report(kDigest);
}

void read_log(const std::string& text) {
  folder().write("attempts/0.tsv", text);
  read_attempts(job());
}

void read_metadata(const std::string& text) {
  folder().write("metadata.json", text);
  Warnings warnings(nullptr);
  const auto metadata = metadata_of(folder().path().string(), "model.obj", warnings);
  if (!metadata) return;
  const auto whole = nlohmann::ordered_json::parse(*metadata);
  fuzz::require(whole.is_object(), "metadata are an object");
  const std::string line = minified_json(*metadata);
  fuzz::require(nlohmann::ordered_json::parse(line) == whole, "without blanks it says the same");
  fuzz::require(line.find('\n') == std::string::npos, "it is one line");
}

void read_pipe(const std::string& text, std::size_t cut) {
  try {
    read_probes(text);
  } catch (const Error& error) {
    fuzz::require(error.kind() == ErrorKind::kInternal, error.what());
  }
  MessageTail whole, pieces;
  whole.add(text);
  for (std::size_t at = 0; at < text.size(); at += cut) pieces.add(text.substr(at, cut));
  fuzz::require(whole.text() == pieces.text(), "the end is the same however a text is cut");
  const WarningTotals totals = read_warnings_line(text);
  fuzz::require(read_warnings_line(warnings_line(totals)) == totals, "totals come back");
}

void read_fields(const std::string& text) {
  const std::vector<std::string> fields = tsv_fields(text);
  const std::string line = tsv_line(fields);
  fuzz::require(tsv_fields(line.substr(0, line.size() - 1)) == fields, "fields come back");
}

void read_files(FuzzedDataProvider& input) {
  const int kind = input.ConsumeIntegralInRange(0, 6);
  const auto cut = input.ConsumeIntegralInRange<std::size_t>(1, 40);
  if (kind == 0) {
    const std::string models = input.ConsumeRandomLengthString(2000);
    return read_manifest(models, input.ConsumeRemainingBytesAsString());
  }
  const std::string text = input.ConsumeRemainingBytesAsString();
  if (kind == 1) read_settings(text);
  if (kind == 2) read_result(text);
  if (kind == 3) read_log(text);
  if (kind == 4) read_metadata(text);
  if (kind == 5) read_pipe(text, cut);
  if (kind == 6) read_fields(text);
}

}  // namespace
}  // namespace atlasgauge

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t bytes) {
  FuzzedDataProvider input(data, bytes);
  atlasgauge::read_files(input);
  return 0;
}
