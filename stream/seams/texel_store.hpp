#pragma once

#include <algorithm>
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

inline constexpr std::uint64_t kLargestTileBytes =
    std::uint64_t{TileLayout::kSide} * TileLayout::kSide * texel_bytes(TexelKind::kFloat);

/// The decoded images of a model, in scratch. Their tiles are numbered, one image after the other.
class TexelStore {
 public:
  TexelStore() = default;
  TexelStore(std::vector<StoredImage> by_slot, std::vector<Spill<TexelPage>> spills);

  const StoredImage& image(SlotId slot) const { return by_slot_[raw(slot)]; }
  std::uint32_t tile_count() const { return tile_count_; }
  /// Reads a tile into `memory`, which is made when first needed and has room for any tile, unless
  /// it is resident.
  LoadedTile load(std::uint32_t tile, AlignedBytes& memory) const;

 private:
  const StoredImage& image_of(std::uint32_t tile) const;
  const std::byte* load_pages(const StoredImage& image, const ImageTile& tile,
                              AlignedBytes& memory) const;

  std::vector<StoredImage> by_slot_;
  std::vector<Spill<TexelPage>> spills_;
  std::vector<std::uint32_t> decoded_;  ///< slots, in the order of their tiles
  std::uint32_t tile_count_ = 0;
};

/// Some tiles in memory, each in the only place where it may be, for one thread.
class TileCache {
 public:
  static constexpr std::uint64_t bytes(std::size_t tiles) {
    return tiles * (kLargestTileBytes + sizeof(Entry));
  }

  TileCache(const TexelStore& store, std::size_t tiles)
      : store_(&store), entries_(std::max<std::size_t>(1, tiles)) {}

  /// Valid until the next call.
  const LoadedTile& at(std::uint32_t tile) {
    Entry& entry = entries_[tile % entries_.size()];
    if (entry.number == tile && entry.loaded.image != nullptr) return entry.loaded;
    entry.number = tile;
    entry.loaded = store_->load(tile, entry.memory);
    return entry.loaded;
  }

 private:
  struct Entry {
    std::uint32_t number = 0;
    LoadedTile loaded{};
    AlignedBytes memory;
  };

  const TexelStore* store_;
  std::vector<Entry> entries_;
};

}  // namespace atlasgauge
