#pragma once

#include <string>
#include <string_view>

namespace atlasgauge {

/// A JSON text on one line: without blanks between its values, and all else byte for byte, so that
/// numbers keep their digits and objects their order. The text must be JSON.
std::string minified_json(std::string_view text);

}  // namespace atlasgauge
