#pragma once

#include <string>

namespace atlasgauge {

/// Throws std::runtime_error for an OpenEXR file that is shorter than an attribute of its header or
/// than the table of blocks that it implies: the library makes room for them before it finds out.
void check_exr_tables(const std::string& path);

}  // namespace atlasgauge
