#pragma once

#include <cstddef>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "io/file/byte_range.hpp"

namespace atlasgauge {

/// What a text of JSON may cost.
struct JsonLimits {
  std::uint64_t memory_bytes = std::uint64_t{64} << 20;  ///< of the text and of what it becomes
  std::size_t depth = 1024;                              ///< of nested arrays and objects
};

/// Whether the member of an object is wanted: what is not takes no memory.
using KeepMember = bool (*)(std::string_view key);

/// Parses a text that may be hostile. Throws Error(kInput) for what is no JSON or too deep, and
/// Error(kResource) for what would take more memory; `path` is for messages.
nlohmann::json parse_json(std::string_view text, const std::string& path, const JsonLimits& limits,
                          KeepMember keep);

/// The same, of bytes that are read first. Nothing is read of a text longer than the limit.
nlohmann::json read_json(const ByteRange& range, const JsonLimits& limits, KeepMember keep);

}  // namespace atlasgauge
