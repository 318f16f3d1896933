#pragma once

#include <cstdint>

namespace atlasgauge {

/// Some of the four texels of a footprint: which footprint of which seam edge, and which texels.
/// Corner c is the texel at (x + c % 2, y + c / 2) of the footprint, v up.
struct FootprintPart {
  std::uint32_t seam;
  std::uint32_t index_low;
  std::uint8_t index_high;
  std::uint8_t lane : 4;     ///< see SeamEdges
  std::uint8_t corners : 4;  ///< bit c for corner c
  /// In a request: where in its tile the lowest of these corners lies, in texels from the top left.
  std::uint8_t column, row;

  /// Footprints of one lane are numbered in the order of its samples.
  std::uint64_t index() const { return std::uint64_t{index_high} << 32 | index_low; }
  /// Orders the parts of one seam edge by lane and footprint.
  std::uint64_t place() const { return std::uint64_t{lane} << 40 | index(); }
};
static_assert(sizeof(FootprintPart) == 12);

/// Asks a tile for the texels of a part.
struct TexelRequest {
  FootprintPart part;
  std::uint32_t tile;

  std::uint32_t key() const { return tile; }
};
static_assert(sizeof(TexelRequest) == 16);

/// The texels of a part: of 8-bit images up to four, corner c from byte 3c on; of others a single
/// one.
struct TexelAnswer {
  static constexpr std::uint32_t kByteTexels = 3;

  FootprintPart part;
  std::uint8_t texels[12];

  std::uint32_t key() const { return part.seam; }
};
static_assert(sizeof(TexelAnswer) == 24);

}  // namespace atlasgauge
