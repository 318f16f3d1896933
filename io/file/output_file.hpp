#pragma once

#include <string>
#include <string_view>

namespace atlasgauge {

/// Throws Error(kResource) if `path` plainly cannot be written, so that a run does not find out at
/// its end. "-" always can.
void check_writable(const std::string& path);

/// Writes a whole file or none: into a file without a name in the same folder, flushed to disk,
/// then renamed over `path`, so an older file stays until the new one is complete; the new one has
/// its owner and permissions. A symbolic link stays, and the file it names is replaced. "-" is
/// standard output; anything that is not a regular file (a pipe, a device) is written directly.
/// To be called while the program has no other threads. Throws Error(kResource).
void write_file(const std::string& path, std::string_view text);

}  // namespace atlasgauge
