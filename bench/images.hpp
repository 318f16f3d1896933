#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

namespace atlasgauge {

/// Paints a row of a square image, counted from the top, three bytes a texel.
using PaintRow = std::function<void(std::uint64_t row, std::uint8_t* texels)>;

/// Smooth waves, plus noise of 0 to 31 a channel so that compression has something to do.
PaintRow waves_and_noise(std::uint64_t size_texels, std::uint64_t image);

/// What a photograph costs: broad gradients, and grain that is nearly the same in all channels. As
/// PNG it takes about 2 bytes a texel, as JPEG a third of one.
PaintRow photo(std::uint64_t size_texels, std::uint64_t image);

PaintRow one_colour(std::uint64_t size_texels, const std::array<std::uint8_t, 3>& colour);

/// Writes an image, a band of rows at a time, in the format that its name ends in. Throws
/// Error(kResource).
void write_image(const std::string& path, std::uint64_t size_texels, const PaintRow& paint);

}  // namespace atlasgauge
