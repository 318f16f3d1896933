#pragma once

#include <optional>

#include "io/image/image_header.hpp"
#include "io/image/image_module_bytes.hpp"

namespace atlasgauge {

/// The header of a JPEG file whose components come in several scans, as in progressive ones: its
/// coefficients are all held until the last scan is read. None for all other files.
std::optional<ImageHeader> header_of_jpeg_of_many_scans(HeaderBytes& file);

}  // namespace atlasgauge
