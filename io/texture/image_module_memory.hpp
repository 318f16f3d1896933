#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <string>

namespace atlasgauge {

/// How many rows the library is asked for at once: it holds them besides as they are stored.
std::uint32_t rows_at_once(const OIIO::ImageSpec& spec);

/// ImageHeader::decoder_bytes of an image that is open.
std::uint64_t decoder_bytes(const std::string& path, const std::string& format,
                            const OIIO::ImageSpec& spec);

}  // namespace atlasgauge
