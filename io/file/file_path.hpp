#pragma once

#include <filesystem>
#include <string>

namespace atlasgauge {

/// A regular file: nothing that a model names may be a pipe or a device, which may never end.
bool is_file(const std::filesystem::path& path);

/// One spelling for all paths to a file, existing or not.
std::string one_spelling(const std::filesystem::path& path);

}  // namespace atlasgauge
