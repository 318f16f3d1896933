#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace atlasgauge {

using Json = nlohmann::ordered_json;

/// The finished measures by key. Values that do not exist (NaN, infinity) are null. The values of
/// textures, of which there may be very many, are asked for one by one each time that the report is
/// written; what they are made of must live as long.
class Report {
 public:
  /// Version of the keys and their meaning, in the report as `schema_version`.
  static constexpr int kSchemaVersion = 1;

  void set(const std::string& key, double value);
  void set(const std::string& key, std::uint64_t value) { values_[key] = value; }
  void set(const std::string& key, std::int64_t value) { values_[key] = value; }
  void set(const std::string& key, bool value) { values_[key] = value; }
  void set(const std::string& key, Json value) { values_[key] = std::move(value); }

  /// Begins a reading of all textures; each call of the result gives the next one's `texture_N`.
  using Textures = std::function<std::function<Json()>()>;
  void set_textures(std::uint64_t count, Textures textures);

  /// The value of a key that is not a texture's: null where nothing measured it. Throws
  /// Error(kInternal) for a key that there is not.
  Json at(const std::string& key) const;

  /// The JSON text, an indented line for each value, handed to `put` piece by piece.
  void write(const std::function<void(std::string_view)>& put) const;

  /// All keys of SPEC sections 2 and 3 in that order, those that nothing measured as null; then any
  /// others, by name.
  Json to_json() const;

 private:
  /// Null where it is not set.
  Json value_of(const std::string& key) const;
  /// Calls use(key, value) for every key, in order.
  void visit(const std::function<void(const std::string&, const Json&)>& use) const;

  std::map<std::string, Json> values_;
  std::uint64_t texture_count_ = 0;
  Textures textures_;
};

}  // namespace atlasgauge
