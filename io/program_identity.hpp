#pragma once

#include <string>

namespace atlasgauge {

/// "0.1.0".
std::string program_version();

/// What tells this program from any other, however little they differ: its version and the build id
/// that the linker made of its content, as in "0.1.0-8a8f2afc1dee". Modules are not part of it.
std::string program_identity();

/// Path of the file that this program was started from. Throws Error(kInternal).
std::string program_path();

}  // namespace atlasgauge
