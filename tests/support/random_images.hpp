#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "tests/support/computed_images.hpp"

namespace atlasgauge {

/// Sizes of images by file name.
using ImageSizes = std::map<std::string, std::pair<std::uint32_t, std::uint32_t>>;

/// Images of those sizes. The rest of them follows from the seed and the file name: bytes, shorts
/// or floats; noise, slopes or one colour; some break off.
ComputedImages random_images(const ImageSizes& sizes, std::uint64_t seed);

}  // namespace atlasgauge
