#include "io/map/map_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <utility>

#include "io/error.hpp"
#include "io/map/exr_output.hpp"

namespace atlasgauge {
namespace {

bool has_type(const MapTexels& texels, MapValue value) {
  return std::holds_alternative<std::span<const float>>(texels) == (value == MapValue::kFloat);
}

std::span<const std::byte> bytes_of(const MapTexels& texels) {
  return std::visit([](auto values) { return std::as_bytes(values); }, texels);
}

bool all_zero(const MapTexels& texels) {
  const std::span<const std::byte> bytes = bytes_of(texels);
  return bytes.front() == std::byte{0} &&
         std::memcmp(bytes.data(), bytes.data() + 1, bytes.size() - 1) == 0;
}

std::uint64_t tile_bytes(std::uint32_t tile_texels, std::size_t channels) {
  return std::uint64_t{tile_texels} * tile_texels * channels * kMapValueBytes;
}

/// The format counts texels and tiles in 32 bits with a sign.
void check_room(const std::string& path, ImageSize size, const MipTiles& tiles) {
  constexpr std::uint32_t kMost = std::numeric_limits<std::int32_t>::max() / 2;
  if (std::max(size.width, size.height) <= kMost && tiles.count() <= kMost) return;
  throw Error(ErrorKind::kUsage, path, 0,
              fmt::format("a map of {}x{} texels in {} tiles is more than an OpenEXR file holds; "
                          "leave out --maps",
                          size.width, size.height, tiles.count()));
}

}  // namespace

std::uint64_t MapFile::memory_bytes(ImageSize size, std::uint32_t tile_texels,
                                    std::size_t channels) {
  constexpr std::uint64_t kOffsetBytes = 8, kOther = 64 << 10;
  const std::uint64_t tiles = MipTiles(size, tile_texels).count();
  return tiles * kOffsetBytes + tiles / 8 + write_bytes(tile_texels, channels) + kOther;
}

std::uint64_t MapFile::write_bytes(std::uint32_t tile_texels, std::size_t channels) {
  // The tile packed and reordered, and 1.3 times as much for the compressed one; zlib.
  constexpr std::uint64_t kOther = 512 << 10;
  return tile_bytes(tile_texels, channels) * 33 / 10 + kOther;
}

MapFile::MapFile(const std::string& path, ImageSize size, std::uint32_t tile_texels,
                 std::span<const MapChannel> channels)
    : tiles_(size, tile_texels),
      tile_texels_(tile_texels),
      channels_(channels.begin(), channels.end()) {
  check_room(path, size, tiles_);
  output_ = std::make_unique<ExrOutput>(path, size, tile_texels, channels);
  begun_.resize(tiles_.count());
  compress_blank_tile();
}

MapFile::~MapFile() = default;

void MapFile::write_tile(std::uint32_t level, std::uint32_t tile_x, std::uint32_t tile_y,
                         std::span<const MapTexels> channels) {
  check_channels(channels);
  begin_tile(level, tile_x, tile_y);
  const ImageSize inside = tiles_.inside_of(level, tile_x, tile_y);
  const exr_chunk_info_t tile = output_->tile(level, tile_x, tile_y, inside);
  if (is_like_blank_tile(channels, inside)) {
    output_->write(tile, blank_tile_);
  } else {
    std::vector<const std::byte*> texels;
    for (const MapTexels& channel : channels) texels.push_back(bytes_of(channel).data());
    const std::size_t row_bytes = tile_texels_ * kMapValueBytes;
    output_->write(tile, output_->compress(tile, texels, row_bytes).bytes());
  }
  ++written_;
}

void MapFile::commit() {
  if (written_ != tiles_.count()) {
    fail(fmt::format("{} tiles are written of {}", written_.load(), tiles_.count()));
  }
  output_->commit();
}

void MapFile::fail(const std::string& text) const {
  throw Error(ErrorKind::kInternal, output_->path(), 0, text);
}

/// Most of a large map may be blank.
void MapFile::compress_blank_tile() {
  const std::vector<std::byte> row(tile_texels_ * kMapValueBytes);
  const std::vector<const std::byte*> texels(channels_.size(), row.data());
  blank_tile_size_ = tiles_.inside_of(0, 0, 0);
  const exr_chunk_info_t tile = output_->tile(0, 0, 0, blank_tile_size_);
  const auto compressed = output_->compress(tile, texels, 0);
  blank_tile_.assign(compressed.bytes().begin(), compressed.bytes().end());
}

void MapFile::check_channels(std::span<const MapTexels> channels) const {
  if (channels.size() != channels_.size()) fail("a tile lacks channels");
  for (std::size_t i = 0; i < channels.size(); ++i) {
    if (!has_type(channels[i], channels_[i].value)) fail("another type: " + channels_[i].name);
    if (bytes_of(channels[i]).size() != tile_bytes(tile_texels_, 1)) {
      fail("no whole tile: " + channels_[i].name);
    }
  }
}

void MapFile::begin_tile(std::uint32_t level, std::uint32_t tile_x, std::uint32_t tile_y) {
  if (!tiles_.has(level, tile_x, tile_y)) {
    fail(fmt::format("there is no tile {} {} {}", level, tile_x, tile_y));
  }
  const std::lock_guard lock(mutex_);
  auto begun = begun_[tiles_.number_of(level, tile_x, tile_y)];
  if (begun) fail(fmt::format("tile {} {} {} comes twice", level, tile_x, tile_y));
  begun = true;
}

/// `inside` is how much of the tile is in the image.
bool MapFile::is_like_blank_tile(std::span<const MapTexels> channels, ImageSize inside) const {
  return inside.width == blank_tile_size_.width && inside.height == blank_tile_size_.height &&
         std::ranges::all_of(channels, all_zero);
}

}  // namespace atlasgauge
