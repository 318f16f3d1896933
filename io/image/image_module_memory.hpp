#pragma once

#include <OpenImageIO/imageio.h>

#include <cstdint>
#include <string>

namespace atlasgauge {

/// How many rows the library is asked for at once: it holds them besides as they are stored.
std::uint32_t rows_at_once(const OIIO::ImageSpec& spec);

/// Memory that every image takes, whatever its format; `row_bytes` as it is stored.
std::uint64_t state_bytes(std::uint64_t row_bytes);

/// ImageHeader::decoder_bytes of an image that is open; `texel_bytes` of the channels that are
/// read.
std::uint64_t decoder_bytes(const std::string& path, const std::string& format,
                            const OIIO::ImageSpec& spec, std::uint64_t texel_bytes);

}  // namespace atlasgauge
