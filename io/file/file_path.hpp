#pragma once

#include <filesystem>
#include <string>

namespace atlasgauge {

/// Anything that can be opened and read, and is no directory.
bool is_file(const std::filesystem::path& path);

/// One spelling for all paths to a file, existing or not.
std::string one_spelling(const std::filesystem::path& path);

}  // namespace atlasgauge
