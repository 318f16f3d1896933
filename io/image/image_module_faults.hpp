#pragma once

#include <string>

namespace atlasgauge {

/// Throws std::runtime_error for headers that the library takes although its buffers do not fit
/// them: it would read or write outside of them. Found by changing bytes of files at random.
void check_header_faults(const std::string& path);

}  // namespace atlasgauge
