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
  /// Of any image.
  std::uint64_t largest_tile_pages() const { return largest_tile_pages_; }
  /// A tile without its texels, unless they are resident.
  LoadedTile find(std::uint32_t tile) const;
  /// Reads pages of an image; `to` is aligned.
  void read(const StoredImage& image, std::uint64_t first_page, std::uint64_t pages,
            std::byte* to) const;

 private:
  const StoredImage& image_of(std::uint32_t tile) const;
  const std::byte* resident(const StoredImage& image, const ImageTile& tile) const;

  std::vector<StoredImage> by_slot_;
  std::vector<Spill<TexelPage>> spills_;
  std::vector<std::uint32_t> decoded_;  ///< slots, in the order of their tiles
  std::uint32_t tile_count_ = 0;
  std::uint64_t largest_tile_pages_ = 0;
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
    entry.loaded = store_->find(tile);
    if (entry.loaded.texels == nullptr) load(entry);
    return entry.loaded;
  }

 private:
  struct Entry {
    std::uint32_t number = 0;
    LoadedTile loaded{};
    AlignedBytes memory;
  };

  void load(Entry& entry) const {
    const ImageTile& tile = entry.loaded.tile;
    if (!entry.memory) entry.memory = AlignedBytes(kLargestTileBytes);
    store_->read(*entry.loaded.image, tile.first_page, tile.pages, entry.memory.data());
    entry.loaded.texels = entry.memory.data();
  }

  const TexelStore* store_;
  std::vector<Entry> entries_;
};

/// Tiles that are asked for in about their order, for one thread: those that follow are read along.
class TileWindow {
 public:
  /// Its memory is that of the pages, but it has room for any tile at least.
  TileWindow(const TexelStore& store, std::uint64_t pages)
      : store_(&store), pages_(std::max(pages, store.largest_tile_pages())) {}

  /// Valid until the next call.
  LoadedTile at(std::uint32_t number) {
    LoadedTile loaded = store_->find(number);
    if (loaded.texels != nullptr) return loaded;
    const ImageTile& tile = loaded.tile;
    const bool is_here =
        image_ == loaded.image && first_ <= tile.first_page && tile.first_page + tile.pages <= end_;
    if (!is_here) load(*loaded.image, tile.first_page);
    loaded.texels = memory_.data() + (tile.first_page - first_) * sizeof(TexelPage);
    return loaded;
  }

 private:
  void load(const StoredImage& image, std::uint64_t first_page) {
    if (!memory_) memory_ = AlignedBytes(pages_ * sizeof(TexelPage));
    image_ = &image;
    first_ = first_page;
    end_ = std::min(first_page + pages_, image.layout.page_count());
    store_->read(image, first_, end_ - first_, memory_.data());
  }

  const TexelStore* store_;
  std::uint64_t pages_;
  AlignedBytes memory_;
  const StoredImage* image_ = nullptr;
  std::uint64_t first_ = 0, end_ = 0;
};

}  // namespace atlasgauge
