#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace atlasgauge {

/// A value as JSON: on one line, or indented by so many blanks a level. Texts that are not UTF-8
/// get replacement characters.
template <class Json>
std::string json_text(const Json& value, int indentation = -1) {
  return value.dump(indentation, ' ', false, Json::error_handler_t::replace);
}

}  // namespace atlasgauge
