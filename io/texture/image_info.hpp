#pragma once

#include <string>

#include "io/texture/texture_slots.hpp"

namespace atlasgauge {

/// Size of an image from its header, through OpenImageIO, which is loaded on the first call: it
/// costs 130 MB resident and 0.2 s, so models without images never pay for it.
/// Throws Error(kInput) if the image cannot be read, Error(kInternal) if the module is missing.
ImageSize read_image_size(const std::string& path);

}  // namespace atlasgauge
