#include "bench/answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string_view>

#include "bench/text_file.hpp"
#include "io/error.hpp"

namespace atlasgauge {
namespace {

bool ends_with(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// How far a report's value of `key` may be from the answer `want`.
double tolerance(const std::string& key, double want, const Answers& answers) {
  const auto& exact = answers.exact_keys;
  if (std::find(exact.begin(), exact.end(), key) != exact.end()) return 0;
  double size = std::abs(want);
  if (ends_with(key, "_var") || ends_with(key, "_stddev")) {
    const std::string rms = key.substr(0, key.rfind('_')) + "_rms";
    const double scale = answers.values.value(rms, 1.0);
    size = ends_with(key, "_var") ? scale * scale : scale;
  }
  return 1e-12 * size;
}

bool agrees(const std::string& key, const nlohmann::json& got, const nlohmann::json& want,
            const Answers& answers) {
  if (want.is_array() && got.is_array()) {
    return std::equal(got.begin(), got.end(), want.begin(), want.end(),
                      [&](const auto& g, const auto& w) { return agrees(key, g, w, answers); });
  }
  if (!want.is_number_float() || !got.is_number()) return got == want;
  const double value = want.get<double>();
  return std::abs(got.get<double>() - value) <= tolerance(key, value, answers);
}

nlohmann::json read_json(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error(ErrorKind::kInput, path, 0, errno_text());
  try {
    return nlohmann::json::parse(file);
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorKind::kInput, path, 0, error.what());
  }
}

}  // namespace

nlohmann::json to_json(const Answers& answers) {
  return {{"values", answers.values}, {"exact", answers.exact_keys}};
}

Answers answers_from_json(const nlohmann::json& json) {
  return {json.at("values"), json.at("exact").get<std::vector<std::string>>()};
}

std::vector<std::string> differences(const nlohmann::json& report, const Answers& answers) {
  std::vector<std::string> lines;
  for (const auto& [key, want] : answers.values.items()) {
    if (!report.contains(key)) {
      lines.push_back(fmt::format("{}: missing, should be {}", key, want.dump()));
    } else if (!agrees(key, report.at(key), want, answers)) {
      lines.push_back(fmt::format("{}: {} instead of {}", key, report.at(key).dump(), want.dump()));
    }
  }
  return lines;
}

std::vector<std::string> differences_of_files(const std::string& report,
                                              const std::string& answers) {
  return differences(read_json(report), answers_from_json(read_json(answers)));
}

void write_answers(const Answers& answers, const std::string& path) {
  TextFile file(path);
  file.put(to_json(answers).dump(1) + "\n");
  file.close();
}

}  // namespace atlasgauge
