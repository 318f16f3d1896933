#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "stream/seams/seam_path.hpp"
#include "stream/seams/texel_lookup.hpp"
#include "stream/seams/texel_store.hpp"

namespace atlasgauge {

/// One axis of a footprint in its image: its two texels, and those that one request may ask for
/// together: neighbours in one tile.
class FootprintAxis {
 public:
  /// `first` and `second` are from the left or the top; `step` is that of second against first
  /// where they are neighbours.
  FootprintAxis(std::int64_t first, std::int64_t second, std::int64_t step, bool may_join)
      : coordinates_{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(second)},
        joined_(may_join && second == first + step &&
                first / TileLayout::kSide == second / TileLayout::kSide) {}

  int parts() const { return joined_ ? 1 : 2; }
  /// The ends of the axis in a part, bit 0 and 1.
  unsigned ends(int part) const { return joined_ ? 3U : 1U << part; }
  std::uint32_t tile(int part) const { return coordinates_[part] / TileLayout::kSide; }
  std::uint8_t in_tile(int part) const {
    return static_cast<std::uint8_t>(coordinates_[part] % TileLayout::kSide);
  }

 private:
  std::uint32_t coordinates_[2];
  bool joined_;
};

/// Coordinates repeat beyond the image, any number of times.
inline std::int64_t repeated(std::int64_t coordinate, std::int64_t size) {
  const std::int64_t rest = coordinate % size;
  return rest < 0 ? rest + size : rest;
}

/// The corners of ends in x and in y.
inline std::uint8_t corners_of(unsigned ends_x, unsigned ends_y) {
  return static_cast<std::uint8_t>(((ends_y & 1) != 0 ? ends_x : 0) |
                                   ((ends_y & 2) != 0 ? ends_x << 2 : 0));
}

/// Calls use(request) for the tiles that hold the texels of a footprint; `part` says whose it is.
template <class Use>
void request_footprint(const StoredImage& image, const Footprint& footprint, FootprintPart part,
                       Use use) {
  const std::int64_t width = image.size.width, height = image.size.height;
  const auto column = [&](std::int64_t x) { return repeated(x, width); };
  const auto row = [&](std::int64_t y) { return height - 1 - repeated(y, height); };
  const bool may_join = image.kind == TexelKind::kByte;
  const FootprintAxis x_axis(column(footprint.x), column(footprint.x + 1), 1, may_join);
  const FootprintAxis y_axis(row(footprint.y), row(footprint.y + 1), -1, may_join);
  for (int j = 0; j < y_axis.parts(); ++j) {
    for (int i = 0; i < x_axis.parts(); ++i) {
      part.corners = corners_of(x_axis.ends(i), y_axis.ends(j)) & 15U;
      part.column = x_axis.in_tile(i);
      part.row = y_axis.in_tile(j);
      use(TexelRequest{
          part, image.first_tile + y_axis.tile(j) * image.layout.columns() + x_axis.tile(i)});
    }
  }
}

/// The texels that a request asks for.
inline TexelAnswer answer_to(const TexelRequest& request, const LoadedTile& tile) {
  TexelAnswer answer{request.part, {}};
  const bool several = tile.image->kind == TexelKind::kByte;
  const auto lowest = static_cast<unsigned>(std::countr_zero(unsigned{request.part.corners}));
  for (unsigned c = lowest; c < 4; ++c) {
    if ((request.part.corners >> c & 1) == 0) continue;
    const std::uint32_t column = request.part.column + c % 2 - lowest % 2;
    const std::uint32_t row = request.part.row + lowest / 2 - c / 2;
    std::memcpy(answer.texels + (several ? c * TexelAnswer::kByteTexels : 0),
                tile.texel(column, row), texel_bytes(tile.image->kind));
  }
  return answer;
}

/// Calls use(request) for all texels that the samples on a side of a seam edge need.
template <class Use>
void request_path(const StoredImage& image, const SeamPath& path, std::uint64_t samples,
                  FootprintPart part, Use use) {
  Footprint last{};
  std::uint64_t footprints = 0;
  for (std::uint64_t i = 0; i < samples; ++i) {
    const Footprint footprint = path.at(i);
    if (i > 0 && footprint.has_texels_of(last)) continue;
    last = footprint;
    part.index_low = static_cast<std::uint32_t>(footprints);
    part.index_high = static_cast<std::uint8_t>(footprints >> 32);
    request_footprint(image, footprint, part, use);
    ++footprints;
  }
}

}  // namespace atlasgauge
