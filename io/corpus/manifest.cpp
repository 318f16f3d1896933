#include "io/corpus/manifest.hpp"

#include <fmt/format.h>

#include <array>
#include <filesystem>

namespace atlasgauge {
namespace {

/// The path of a report is made of it.
bool stays_below(const std::string& path) {
  const std::filesystem::path relative(path);
  if (path.empty() || relative.is_absolute()) return false;
  for (const std::filesystem::path& step : relative) {
    if (step == "..") return false;
  }
  return true;
}

}  // namespace

ManifestWriter::ManifestWriter(const CorpusJob& job)
    : models_(job.manifest_path()), inputs_(job.inputs_path()) {
  models_.append("#slice\tseconds\tbytes\tfiles\tdigest\tpath\n");
  inputs_.append("#bytes\tmodified_ns\tpath\n");
}

void ManifestWriter::add_input(const InputFile& input) {
  inputs_.append(tsv_line(
      std::array{std::to_string(input.bytes), std::to_string(input.modified_ns), input.path}));
}

void ManifestWriter::add_model(const PlannedModel& model) {
  models_.append(tsv_line(std::array{
      std::to_string(model.slice), fmt::format("{:.3f}", model.seconds),
      std::to_string(model.bytes), std::to_string(model.files), model.digest, model.path}));
}

void ManifestWriter::commit() {
  inputs_.commit();
  models_.commit();
}

ManifestReader::ManifestReader(const CorpusJob& job)
    : models_(job.manifest_path()), input_lines_(job.inputs_path()) {}

std::optional<PlannedModel> ManifestReader::next() {
  if (!models_.next()) return std::nullopt;
  PlannedModel model{models_.whole(0), models_.number(1), models_.whole(2),
                     models_.whole(3), models_.text(4),   models_.text(5)};
  if (!stays_below(model.path)) {
    models_.refuse("'" + model.path + "' is not a path below the root of the corpus");
  }
  read_inputs(model.files);
  return model;
}

void ManifestReader::read_inputs(std::uint64_t files) {
  inputs_.clear();
  while (inputs_.size() < files) {
    if (!input_lines_.next()) input_lines_.refuse("it ends before the inputs of all models");
    inputs_.push_back({input_lines_.text(2), input_lines_.whole(0), input_lines_.integer(1)});
  }
}

}  // namespace atlasgauge
