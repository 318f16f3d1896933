#include "io/corpus/model_result.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "io/corpus/input_digest.hpp"
#include "io/error.hpp"
#include "io/file/descriptor.hpp"
#include "io/file/module.hpp"
#include "io/file/output_file.hpp"
#include "io/file/output_folder.hpp"
#include "io/image/image_module.hpp"
#include "io/json/json_text.hpp"
#include "io/program_identity.hpp"

namespace atlasgauge {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kMeasured = "measured";
constexpr const char* kFailed = "failed";

Json head_of(const ModelResult& result, std::string_view report) {
  return {{"model", result.model},
          {"program", result.program},
          {"status", result.measured ? kMeasured : kFailed},
          {"reason", result.reason},
          {"warnings", result.warnings},
          {"report_bytes", report.size()}};
}

/// Throws an exception of the JSON library where something is missing or of another kind.
ModelResult result_from(const Json& head) {
  ModelResult result;
  head.at("model").get_to(result.model);
  head.at("program").get_to(result.program);
  head.at("reason").get_to(result.reason);
  head.at("warnings").get_to(result.warnings);
  result.measured = head.at("status") == kMeasured;
  return result;
}

/// From where a file is read to its end.
std::int64_t rest_bytes(std::ifstream& file) {
  const auto begin = file.tellg();
  file.seekg(0, std::ios::end);
  return file.tellg() - begin;
}

/// "-t64x64-lod3-strict" for -t 64x64 --lod 3 --strict.
std::string name_of(const std::vector<std::string>& arguments) {
  std::string name;
  for (const std::string& argument : arguments) {
    const std::size_t dashes = argument.find_first_not_of('-');
    if (dashes > 0) name += '-';
    name += argument.substr(dashes);
  }
  return name;
}

/// The program with its module for images; what OSMesa draws is the same as without.
std::string measuring_identity() {
  constexpr std::size_t kShownDigits = 8;
  const std::optional<std::string> images = module_path(kImageModule);
  if (!images) return program_identity();
  const std::string folder = std::filesystem::path(*images).parent_path().string();
  return program_identity() + "-" + digest_inputs(folder, {*images}).hex.substr(0, kShownDigits);
}

/// So that a file that was renamed stays so.
void sync_folder(const std::string& path) {
  const Descriptor folder(::open(path.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder) ::fsync(folder.get());
}

}  // namespace

ResultStore::ResultStore(const CorpusJob& job, const CorpusSettings& settings)
    : folder_(job.results_path()),
      suffix_("-" + measuring_identity() + name_of(settings.arguments) + ".result") {}

/// In folders of 1/256 of them.
std::string ResultStore::path_of(const std::string& digest) const {
  return folder_ + "/" + digest.substr(0, 2) + "/" + digest + suffix_;
}

std::optional<ModelResult> ResultStore::find(const std::string& digest) const {
  std::ifstream file(path_of(digest), std::ios::binary);
  std::string line;
  if (!std::getline(file, line)) return std::nullopt;
  try {
    const Json head = Json::parse(line);
    if (rest_bytes(file) != head.at("report_bytes")) return std::nullopt;
    return result_from(head);
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::string ResultStore::report(const std::string& digest) const {
  std::ifstream file(path_of(digest), std::ios::binary);
  std::string line;
  if (!std::getline(file, line)) {
    throw Error(ErrorKind::kInput, path_of(digest), 0, "the result went away while it was read");
  }
  return {std::istreambuf_iterator<char>(file), {}};
}

void ResultStore::write(const std::string& digest, const ModelResult& result,
                        std::string_view report) const {
  const std::string folder = folder_ + "/" + digest.substr(0, 2);
  make_output_folder(folder);
  OutputFile file(path_of(digest));
  file.append(json_text(head_of(result, report)) + "\n");
  file.append(report);
  file.commit();
  sync_folder(folder);
  sync_folder(folder_);
}

}  // namespace atlasgauge
