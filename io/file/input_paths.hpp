#pragma once

#include <string>
#include <vector>

namespace atlasgauge {

/// The files that are meant by names and glob patterns (*, ?, [...]), in the order given; those of
/// a pattern by name, byte by byte. A name that exists is no pattern. Throws Error(kInput) for a
/// pattern that no file matches.
std::vector<std::string> expand_input_paths(const std::vector<std::string>& names);

}  // namespace atlasgauge
