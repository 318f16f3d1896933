#pragma once

#include <string>

namespace atlasgauge {

/// Throws std::runtime_error for an OpenEXR file that is shorter than the table of blocks that its
/// header implies: the library makes tables of all rows before it finds that out.
void check_exr_tables(const std::string& path);

}  // namespace atlasgauge
