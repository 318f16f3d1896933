#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "io/texture/texture_slots.hpp"

namespace atlasgauge {

/// Writes a whole PNG file or none, as write_file does: three bytes a texel (red, green, blue), as
/// they are, rows from the top down. Loads the image module (see image_module.hpp), and holds up to
/// three bytes a texel twice. Throws Error(kResource) if the file cannot be written.
void write_png(const std::string& path, ImageSize size, std::span<const std::uint8_t> rgb);

}  // namespace atlasgauge
