#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace atlasgauge {

/// What a report on a generated model must say, by formula from the model's parameters.
struct Answers {
  nlohmann::json values;                ///< by the keys of the report
  std::vector<std::string> exact_keys;  ///< reals that are dyadic, terms and sums alike
};

/// As a file holds them: {"values": {...}, "exact": [...]}.
nlohmann::json to_json(const Answers& answers);
Answers answers_from_json(const nlohmann::json& json);

/// A line for every answer that `report` misses or contradicts. Reals that are not exact may differ
/// by 1e-12 of themselves; a variance by 1e-12 of the mean square, since its own size may be 0.
std::vector<std::string> differences(const nlohmann::json& report, const Answers& answers);

/// The same for files. Throws Error(kInput) for one that cannot be read.
std::vector<std::string> differences_of_files(const std::string& report,
                                              const std::string& answers);

void write_answers(const Answers& answers, const std::string& path);

}  // namespace atlasgauge
