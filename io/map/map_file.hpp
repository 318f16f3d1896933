#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "io/map/map_channel.hpp"
#include "io/map/mip_tiles.hpp"
#include "io/texture/texture_slots.hpp"

namespace atlasgauge {

class ExrOutput;

/// A tiled OpenEXR image with all its mip levels, written tile by tile in any order, that is there
/// whole or not at all: see UnnamedFile. Lossless. Sides of a level are halved and rounded down,
/// and end at 1 for both; tiles at the right and the lower border are cut off.
///
/// To be opened and committed while the program has no other threads. Throws Error(kResource) when
/// the file cannot be written.
class MapFile {
 public:
  /// What it holds from its opening to its end.
  static std::uint64_t memory_bytes(ImageSize size, std::uint32_t tile_texels,
                                    std::size_t channels);
  /// What one call of write_tile holds meanwhile.
  static std::uint64_t write_bytes(std::uint32_t tile_texels, std::size_t channels);

  /// `tile_texels` is the side of a tile. Throws Error(kUsage) for an image that the format has no
  /// room for.
  MapFile(const std::string& path, ImageSize size, std::uint32_t tile_texels,
          std::span<const MapChannel> channels);
  ~MapFile();
  MapFile(const MapFile&) = delete;
  MapFile& operator=(const MapFile&) = delete;

  std::uint32_t level_count() const { return tiles_.levels(); }
  ImageSize level_size(std::uint32_t level) const { return tiles_.size_of(level); }
  /// Tiles across and down.
  ImageSize level_tiles(std::uint32_t level) const { return tiles_.tiles_of(level); }

  /// A whole tile, even where only a part of it is in the image; channels in the order in which
  /// they were named. Each tile once. Thread-safe, and most of it runs in parallel.
  void write_tile(std::uint32_t level, std::uint32_t tile_x, std::uint32_t tile_y,
                  std::span<const MapTexels> channels);

  /// After all tiles.
  void commit();

 private:
  [[noreturn]] void fail(const std::string& text) const;
  void compress_blank_tile();
  void check_channels(std::span<const MapTexels> channels) const;
  void begin_tile(std::uint32_t level, std::uint32_t tile_x, std::uint32_t tile_y);
  bool is_like_blank_tile(std::span<const MapTexels> channels, ImageSize inside) const;

  const MipTiles tiles_;
  const std::uint32_t tile_texels_;
  const std::vector<MapChannel> channels_;
  std::unique_ptr<ExrOutput> output_;
  std::vector<std::byte> blank_tile_;  ///< compressed
  ImageSize blank_tile_size_;
  std::mutex mutex_;
  std::vector<bool> begun_;
  std::atomic<std::uint64_t> written_{0};
};

}  // namespace atlasgauge
