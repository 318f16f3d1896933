#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "io/ids.hpp"
#include "stream/engine/spill.hpp"
#include "stream/seams/tile_layout.hpp"

namespace atlasgauge {

/// Where the texels of a slot's image are.
struct StoredImage {
  bool decoded = false;
  TexelKind kind = TexelKind::kByte;
  ImageSize size;
  TileLayout layout;
  std::size_t spill = 0;  ///< of the store
  std::uint64_t first_page = 0;
  std::uint32_t first_tile = 0;  ///< its number among those of all images
};

/// A tile in memory.
struct LoadedTile {
  const StoredImage* image;
  ImageTile tile;
  const std::byte* texels;

  const std::byte* texel(std::uint32_t column, std::uint32_t row) const {
    return texels + (std::size_t{row} * tile.width + column) * texel_bytes(image->kind);
  }
};

/// The decoded images of a model, in scratch. Their tiles are numbered, one image after the other.
class TexelStore {
 public:
  TexelStore() = default;
  TexelStore(std::vector<StoredImage> by_slot, std::vector<Spill<TexelPage>> spills);

  const StoredImage& image(SlotId slot) const { return by_slot_[raw(slot)]; }
  std::uint32_t tile_count() const { return tile_count_; }
  /// Reads tiles, for one thread.
  class Reader {
   public:
    static constexpr std::uint64_t kMemoryBytes =
        TileLayout::kSide * TileLayout::kSide * texel_bytes(TexelKind::kFloat);

    explicit Reader(const TexelStore& store) : store_(store) {}
    /// Valid until the next call.
    LoadedTile load(std::uint32_t tile);

   private:
    const std::byte* load_pages(const StoredImage& image, const ImageTile& tile);

    const TexelStore& store_;
    AlignedBytes memory_;
  };

 private:
  const StoredImage& image_of(std::uint32_t tile) const;

  std::vector<StoredImage> by_slot_;
  std::vector<Spill<TexelPage>> spills_;
  std::vector<std::uint32_t> decoded_;  ///< slots, in the order of their tiles
  std::uint32_t tile_count_ = 0;
};

}  // namespace atlasgauge
