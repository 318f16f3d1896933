#pragma once

#include <string>

namespace atlasgauge {

/// Makes the folder unless it is there; the one it lies in must be. Throws Error(kResource) if it
/// cannot be made, or files cannot be written there.
void make_output_folder(const std::string& path);

}  // namespace atlasgauge
