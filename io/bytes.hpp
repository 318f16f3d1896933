#pragma once

#include <cstdint>
#include <string>

namespace atlasgauge {

/// "512M", "2G", "4MiB", "1048576": K, M, G, T are powers of 1024, with or without B or iB.
/// Throws Error(kUsage).
std::uint64_t parse_bytes(const std::string& text);

/// "12.3 MiB".
std::string format_bytes(std::uint64_t bytes);

}  // namespace atlasgauge
