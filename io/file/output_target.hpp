#pragma once

#include <string>
#include <string_view>

namespace atlasgauge {

/// Throws Error(kResource): `path` cannot be written, for that reason.
[[noreturn]] void fail_to_write(const std::string& path, const std::string& reason);

/// The file that a chain of symbolic links ends at, there or not. Throws if nothing can be written
/// there.
std::string output_target(const std::string& path);

/// True for what is there and is no regular file: a pipe, a device.
bool is_special(const std::string& target);

std::string folder_of(const std::string& path);

/// Writes all of it, however little a call takes. `path` is for the error.
void write_all(int fd, const std::string& path, std::string_view bytes);

}  // namespace atlasgauge
