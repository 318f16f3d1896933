#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "io/image/image_header.hpp"
#include "stream/engine/scratch.hpp"

namespace atlasgauge {

/// The unit of texels in scratch.
struct TexelPage {
  std::byte bytes[Scratch::kAlignment];
};

/// A rectangle of an image, its rows from the top, without padding between them.
struct ImageTile {
  std::uint64_t first_page;
  std::uint32_t pages;
  std::uint32_t width, height;  ///< texels
};

/// How an image lies in scratch: tiles of 64 x 64 texels, those at the right and lower borders as
/// small as they are, row by row from the top left, each from the beginning of a page.
class TileLayout {
 public:
  static constexpr std::uint32_t kSide = 64;

  TileLayout() = default;
  TileLayout(ImageSize size, TexelKind kind)
      : size_(size), texel_bytes_(texel_bytes(kind)), columns_((size.width + kSide - 1) / kSide) {}

  std::uint32_t columns() const { return columns_; }
  std::uint32_t rows() const { return (size_.height + kSide - 1) / kSide; }
  std::uint64_t tile_count() const { return std::uint64_t{columns()} * rows(); }
  std::uint64_t page_count() const {
    return tile_count() == 0 ? 0 : end_of(tile(tile_count() - 1));
  }
  /// All rows of texels that a row of tiles holds.
  std::uint64_t band_bytes() const {
    return std::uint64_t{size_.width} * std::min(kSide, size_.height) * texel_bytes_;
  }

  ImageTile tile(std::uint64_t index) const {
    const auto row = static_cast<std::uint32_t>(index / columns_);
    const auto column = static_cast<std::uint32_t>(index % columns_);
    const std::uint32_t width = std::min(kSide, size_.width - column * kSide);
    const std::uint32_t height = std::min(kSide, size_.height - row * kSide);
    const std::uint64_t before =
        row * row_pages(kSide) + std::uint64_t{column} * pages(kSide, height);
    return {before, pages(width, height), width, height};
  }

 private:
  static std::uint64_t end_of(const ImageTile& tile) { return tile.first_page + tile.pages; }
  std::uint32_t pages(std::uint32_t width, std::uint32_t height) const {
    const std::size_t bytes = std::size_t{width} * height * texel_bytes_;
    return static_cast<std::uint32_t>((bytes + sizeof(TexelPage) - 1) / sizeof(TexelPage));
  }
  std::uint64_t row_pages(std::uint32_t height) const {
    const std::uint32_t last_width = size_.width - (columns_ - 1) * kSide;
    return std::uint64_t{columns_ - 1} * pages(kSide, height) + pages(last_width, height);
  }

  ImageSize size_;
  std::uint32_t texel_bytes_ = 0;
  std::uint32_t columns_ = 0;
};

}  // namespace atlasgauge
