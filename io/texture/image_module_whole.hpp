#pragma once

#include <optional>
#include <string>

#include "io/texture/image_header.hpp"

namespace atlasgauge {

/// The header of an image that the library would decode as a whole already to tell its header:
/// then the library need not be asked. None for all others.
std::optional<ImageHeader> header_of_image_held_whole(const std::string& path);

}  // namespace atlasgauge
