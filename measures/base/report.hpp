#pragma once

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace atlasgauge {

using Json = nlohmann::ordered_json;

/// The finished measures by key. Values that do not exist (NaN, infinity) are null.
class Report {
 public:
  /// Version of the keys and their meaning, in the report as `schema_version`.
  static constexpr int kSchemaVersion = 1;

  void set(const std::string& key, double value);
  void set(const std::string& key, std::uint64_t value) { values_[key] = value; }
  void set(const std::string& key, std::int64_t value) { values_[key] = value; }
  void set(const std::string& key, bool value) { values_[key] = value; }
  void set(const std::string& key, Json value) { values_[key] = std::move(value); }

  const Json& at(const std::string& key) const;

  /// All keys of SPEC sections 2 and 3 in that order, those that nothing measured as null; then any
  /// others, by name.
  Json to_json() const;

 private:
  std::map<std::string, Json> values_;
};

}  // namespace atlasgauge
