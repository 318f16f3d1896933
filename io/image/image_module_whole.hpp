#pragma once

#include <optional>
#include <string>

#include "io/image/image_header.hpp"

namespace atlasgauge {

/// The header of an image that the library would read as a whole already to tell its header, which
/// it is therefore not asked for. `decoder_bytes` is what it will hold. None for all others.
std::optional<ImageHeader> header_of_image_held_whole(const std::string& path);

}  // namespace atlasgauge
