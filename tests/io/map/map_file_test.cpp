#include "io/map/map_file.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfTiledInputFile.h>
#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <openexr.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "io/error.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using Names = std::vector<std::string>;

/// Bits of the value of a channel at a texel.
using Content = std::function<std::uint32_t(std::size_t channel, std::uint32_t level,
                                            std::uint32_t x, std::uint32_t y)>;

struct Tile {
  std::uint32_t level, x, y;
};

// Not in the order of their names, which is that of the file.
const std::vector<MapChannel> kChannels = {
    {"sf", MapValue::kFloat}, {"chart", MapValue::kUint}, {"qcd", MapValue::kFloat}};

std::uint32_t speckled(std::size_t channel, std::uint32_t level, std::uint32_t x, std::uint32_t y) {
  const double value = static_cast<double>(channel + 1) + 0.25 * (x / 3) - 0.5 * (y / 5);
  return std::bit_cast<std::uint32_t>(static_cast<float>(value)) + level;
}

std::uint32_t random_bits(std::size_t channel, std::uint32_t level, std::uint32_t x,
                          std::uint32_t y) {
  std::uint64_t bits = (channel * 31 + level) * 0x9E3779B97F4A7C15U + x * 0xBF58476D1CE4E5B9U +
                       y * 0x94D049BB133111EBU;
  bits ^= bits >> 30;
  bits *= 0xBF58476D1CE4E5B9U;
  bits ^= bits >> 27;
  return static_cast<std::uint32_t>(bits * 0x94D049BB133111EBU >> 32);
}

std::vector<Tile> tiles_of(const MapFile& map) {
  std::vector<Tile> tiles;
  for (std::uint32_t level = 0; level < map.level_count(); ++level) {
    const ImageSize count = map.level_tiles(level);
    for (std::uint32_t y = 0; y < count.height; ++y) {
      for (std::uint32_t x = 0; x < count.width; ++x) tiles.push_back({level, x, y});
    }
  }
  return tiles;
}

/// Values of a tile, with noise where it is outside of the level.
class TileTexels {
 public:
  TileTexels(const MapFile& map, Tile tile, std::uint32_t side, const Content& content) {
    const ImageSize size = map.level_size(tile.level);
    for (std::size_t channel = 0; channel < kChannels.size(); ++channel) {
      for (std::uint32_t i = 0; i < side * side; ++i) {
        const std::uint32_t x = tile.x * side + i % side, y = tile.y * side + i / side;
        const bool inside = x < size.width && y < size.height;
        const std::uint32_t bits = inside ? content(channel, tile.level, x, y) : 0xDEADBEEFU;
        floats_[channel].push_back(std::bit_cast<float>(bits));
        uints_[channel].push_back(bits);
      }
    }
  }

  std::vector<MapTexels> channels() const {
    std::vector<MapTexels> texels;
    for (std::size_t i = 0; i < kChannels.size(); ++i) {
      if (kChannels[i].value == MapValue::kFloat) texels.emplace_back(std::span(floats_[i]));
      if (kChannels[i].value == MapValue::kUint) texels.emplace_back(std::span(uints_[i]));
    }
    return texels;
  }

 private:
  std::vector<float> floats_[3];
  std::vector<std::uint32_t> uints_[3];
};

void write(MapFile& map, Tile tile, std::uint32_t side, const Content& content) {
  const TileTexels texels(map, tile, side, content);
  map.write_tile(tile.level, tile.x, tile.y, texels.channels());
}

void write_shuffled(const std::string& path, ImageSize size, std::uint32_t side,
                    const Content& content) {
  MapFile map(path, size, side, kChannels);
  std::vector<Tile> tiles = tiles_of(map);
  std::ranges::shuffle(tiles, std::mt19937(side));
  for (const Tile tile : tiles) write(map, tile, side, content);
  map.commit();
}

/// The bits of a channel in a level, read by the library's other interface.
std::vector<std::uint32_t> read_level(Imf::TiledInputFile& file, const MapChannel& channel,
                                      std::uint32_t level) {
  const auto k = static_cast<int>(level);
  const int width = file.levelWidth(k), height = file.levelHeight(k);
  std::vector<std::uint32_t> bits(static_cast<std::size_t>(width) *
                                  static_cast<std::size_t>(height));
  Imf::FrameBuffer buffer;
  buffer.insert(channel.name, Imf::Slice(channel.value == MapValue::kFloat ? Imf::FLOAT : Imf::UINT,
                                         reinterpret_cast<char*>(bits.data()), 4,
                                         4 * static_cast<std::size_t>(width)));
  file.setFrameBuffer(buffer);
  file.readTiles(0, file.numXTiles(k) - 1, 0, file.numYTiles(k) - 1, k);
  return bits;
}

void expect_content(const std::string& path, ImageSize size, const Content& content) {
  Imf::TiledInputFile file(path.c_str());
  ASSERT_TRUE(file.isComplete());
  const std::uint32_t levels = std::bit_width(std::max(size.width, size.height));
  ASSERT_EQ(static_cast<std::uint32_t>(file.numLevels()), levels);
  for (std::uint32_t level = 0; level < levels; ++level) {
    const std::uint32_t width = std::max(size.width >> level, 1U);
    const std::uint32_t height = std::max(size.height >> level, 1U);
    for (std::size_t channel = 0; channel < kChannels.size(); ++channel) {
      const auto bits = read_level(file, kChannels[channel], level);
      ASSERT_EQ(bits.size(), std::size_t{width} * height);
      std::size_t wrong = 0;
      for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
          wrong += bits[std::size_t{y} * width + x] == content(channel, level, x, y) ? 0 : 1;
        }
      }
      EXPECT_EQ(wrong, 0U) << kChannels[channel].name << " of level " << level;
    }
  }
}

class MapFileTest : public testing::Test {
 protected:
  template <class Work>
  ErrorKind error_kind(Work work) {
    try {
      work();
    } catch (const Error& error) {
      error_ = error.what();
      return error.kind();
    }
    error_ = "";
    return ErrorKind{};
  }

  TempDir dir_;
  const std::string path_ = (dir_.path() / "map.exr").string();
  std::string error_;
};

TEST_F(MapFileTest, EveryTexelOfEveryLevelReadsBack) {
  for (const ImageSize size : {ImageSize{1, 1}, ImageSize{100, 37}, ImageSize{64, 64},
                               ImageSize{3, 300}, ImageSize{257, 129}, ImageSize{512, 1}}) {
    for (const std::uint32_t side : {8U, 64U, 256U}) {
      SCOPED_TRACE(std::to_string(size.width) + "x" + std::to_string(size.height) + " by " +
                   std::to_string(side));
      write_shuffled(path_, size, side, speckled);
      expect_content(path_, size, speckled);
    }
  }
}

TEST_F(MapFileTest, TexelsThatCannotBeCompressedReadBack) {
  write_shuffled(path_, {200, 100}, 32, random_bits);
  expect_content(path_, {200, 100}, random_bits);
}

TEST_F(MapFileTest, TilesAsLongCompressedAsNotReadBack) {
  for (std::uint32_t shape = 0; shape < 500; ++shape) {
    const Content content = [&](std::size_t channel, std::uint32_t level, std::uint32_t x,
                                std::uint32_t y) {
      return random_bits(channel, level, x, y) >> shape % 32 << shape / 32;
    };
    write_shuffled(path_, {4, 3}, 8, content);
    expect_content(path_, {4, 3}, content);
  }
}

TEST_F(MapFileTest, BlankTilesReadBackAmongOthers) {
  const Content content = [](std::size_t channel, std::uint32_t, std::uint32_t x, std::uint32_t y) {
    return x / 32 == 1 || y / 64 == 1 ? 0 : static_cast<std::uint32_t>(channel + x * y);
  };
  write_shuffled(path_, {200, 150}, 32, content);
  expect_content(path_, {200, 150}, content);
}

TEST_F(MapFileTest, OneBitMakesATileNotBlank) {
  const Content last = [](std::size_t channel, std::uint32_t, std::uint32_t x, std::uint32_t y) {
    return channel == 2 && x == 31 && y == 31 ? 1U : 0U;
  };
  const Content negative_zero = [](std::size_t channel, std::uint32_t, std::uint32_t,
                                   std::uint32_t) { return channel == 0 ? 0x80000000U : 0U; };
  for (const Content& content : {last, negative_zero}) {
    write_shuffled(path_, {64, 64}, 32, content);
    expect_content(path_, {64, 64}, content);
  }
}

TEST_F(MapFileTest, NumbersThatAreNoneReadBack) {
  const Content content = [](std::size_t, std::uint32_t, std::uint32_t x, std::uint32_t y) {
    const float values[] = {std::numeric_limits<float>::infinity(),
                            -std::numeric_limits<float>::infinity(), std::nanf("1"),
                            std::numeric_limits<float>::denorm_min()};
    return std::bit_cast<std::uint32_t>(values[(x + y) % 4]);
  };
  write_shuffled(path_, {50, 50}, 16, content);
  expect_content(path_, {50, 50}, content);
}

TEST_F(MapFileTest, AnotherLibraryReadsTheSame) {
  constexpr ImageSize kSize{100, 37};
  write_shuffled(path_, kSize, 16, speckled);
  const auto image = OIIO::ImageInput::open(path_);
  ASSERT_TRUE(image) << OIIO::geterror();
  const Names names = image->spec().channelnames;
  ASSERT_EQ(names, (Names{"chart", "qcd", "sf"}));
  for (int level = 0; level < 7; ++level) {
    ASSERT_TRUE(image->seek_subimage(0, level));
    const int width = std::max(100 >> level, 1), height = std::max(37 >> level, 1);
    ASSERT_EQ(image->spec(0, level).width, width);
    ASSERT_EQ(image->spec(0, level).height, height);
    EXPECT_EQ(image->spec(0, level).tile_width, 16);
    std::vector<float> sf(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    ASSERT_TRUE(image->read_image(0, level, 2, 3, OIIO::TypeDesc::FLOAT, sf.data()));
    for (std::size_t i = 0; i < sf.size(); ++i) {
      const auto w = static_cast<std::size_t>(width);
      ASSERT_EQ(std::bit_cast<std::uint32_t>(sf[i]),
                speckled(0, static_cast<std::uint32_t>(level), static_cast<std::uint32_t>(i % w),
                         static_cast<std::uint32_t>(i / w)));
    }
  }
  EXPECT_FALSE(image->seek_subimage(0, 7));
}

TEST_F(MapFileTest, ThreadsMayBringTiles) {
  constexpr ImageSize kSize{300, 300};
  MapFile map(path_, kSize, 16, kChannels);
  const std::vector<Tile> tiles = tiles_of(map);
  std::atomic<std::size_t> next{0};
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 4; ++i) {
      threads.emplace_back([&] {
        for (std::size_t k = 0; (k = next++) < tiles.size();) write(map, tiles[k], 16, speckled);
      });
    }
  }
  map.commit();
  expect_content(path_, kSize, speckled);
}

TEST_F(MapFileTest, NothingHasANameBeforeTheCommit) {
  {
    MapFile map(path_, {40, 40}, 16, kChannels);
    for (const Tile tile : tiles_of(map)) write(map, tile, 16, speckled);
    EXPECT_EQ(names_in(dir_.path()), Names{});
  }
  EXPECT_EQ(names_in(dir_.path()), Names{}) << "nor is anything left without it";
}

TEST_F(MapFileTest, MapWithoutAllTilesIsNotCommitted) {
  MapFile map(path_, {40, 40}, 16, kChannels);
  std::vector<Tile> tiles = tiles_of(map);
  tiles.pop_back();
  for (const Tile tile : tiles) write(map, tile, 16, speckled);
  EXPECT_EQ(error_kind([&] { map.commit(); }), ErrorKind::kInternal);
  EXPECT_EQ(names_in(dir_.path()), Names{});
}

TEST_F(MapFileTest, TilesThatDoNotFitAreRefused) {
  MapFile map(path_, {40, 40}, 16, kChannels);
  const TileTexels right(map, {0, 0, 0}, 16, speckled), small(map, {0, 0, 0}, 8, speckled);
  std::vector<MapTexels> swapped = right.channels();
  std::swap(swapped[0], swapped[1]);
  const auto kind = [&](Tile tile, std::span<const MapTexels> texels) {
    return error_kind([&] { map.write_tile(tile.level, tile.x, tile.y, texels); });
  };
  EXPECT_EQ(kind({0, 3, 0}, right.channels()), ErrorKind::kInternal);
  EXPECT_EQ(kind({0, 0, 3}, right.channels()), ErrorKind::kInternal);
  EXPECT_EQ(kind({6, 0, 0}, right.channels()), ErrorKind::kInternal);
  EXPECT_EQ(kind({0, 0, 0}, small.channels()), ErrorKind::kInternal);
  EXPECT_EQ(kind({0, 0, 0}, swapped), ErrorKind::kInternal);
  EXPECT_EQ(kind({0, 0, 0}, std::span(swapped).first(2)), ErrorKind::kInternal);
  EXPECT_EQ(kind({0, 0, 0}, right.channels()), ErrorKind{}) << error_;
  EXPECT_EQ(kind({0, 0, 0}, right.channels()), ErrorKind::kInternal) << "twice";
}

TEST_F(MapFileTest, MoreThanTheFormatHoldsIsRefused) {
  EXPECT_EQ(error_kind([&] {
              MapFile(path_, {4'000'000'000U, 1}, 64, kChannels);
            }),
            ErrorKind::kUsage);
  EXPECT_NE(error_.find("4000000000x1"), std::string::npos) << error_;
  EXPECT_EQ(error_kind([&] {
              MapFile(path_, {1U << 20, 1U << 20}, 8, kChannels);
            }),
            ErrorKind::kUsage);
  EXPECT_EQ(names_in(dir_.path()), Names{});
}

TEST_F(MapFileTest, FullDiskIsAnErrorWithThePathAndLeavesTheOldFile) {
  dir_.write("map.exr", "old");
  write_shuffled((dir_.path() / "whole.exr").string(), {100, 100}, 16, random_bits);
  const std::uint64_t whole = std::filesystem::file_size(dir_.path() / "whole.exr");
  std::filesystem::remove(dir_.path() / "whole.exr");
  for (const std::uint64_t bytes : {std::uint64_t{0}, std::uint64_t{100}, whole / 2, whole - 1}) {
    const FileSizeLimit limit(bytes);
    EXPECT_EQ(error_kind([&] {
                write_shuffled(path_, {100, 100}, 16, random_bits);
              }),
              ErrorKind::kResource);
    EXPECT_TRUE(error_.starts_with(path_)) << error_;
    EXPECT_NE(error_.find("File too large"), std::string::npos) << error_;
  }
  EXPECT_EQ(content_of(path_), "old");
  EXPECT_EQ(names_in(dir_.path()), Names{"map.exr"});
}

TEST_F(MapFileTest, DevicesAndMissingFoldersAreRefused) {
  for (const std::string path : {"/dev/full", "/none/map.exr"}) {
    EXPECT_EQ(error_kind([&] { MapFile(path, {4, 4}, 16, kChannels); }), ErrorKind::kResource);
    EXPECT_TRUE(error_.starts_with(path)) << error_;
  }
}

// What the library takes of the heap.
std::atomic<std::uint64_t> held_bytes{0}, most_held_bytes{0};

void* counted_alloc(std::size_t bytes) {
  constexpr std::size_t kFront = alignof(std::max_align_t);
  auto* const front = static_cast<std::size_t*>(std::malloc(bytes + kFront));
  if (front == nullptr) return nullptr;
  *front = bytes;
  held_bytes += bytes;
  most_held_bytes = std::max(most_held_bytes.load(), held_bytes.load());
  return reinterpret_cast<char*>(front) + kFront;
}

void counted_free(void* data) {
  if (data == nullptr) return;
  constexpr std::size_t kFront = alignof(std::max_align_t);
  char* const front = static_cast<char*>(data) - kFront;
  held_bytes -= *reinterpret_cast<std::size_t*>(front);
  std::free(front);
}

TEST_F(MapFileTest, MemoryIsNoMoreThanItSays) {
  exr_set_default_memory_routines(counted_alloc, counted_free);
  for (const std::uint32_t side : {8U, 64U, 256U}) {
    most_held_bytes = held_bytes = 0;
    MapFile map(path_, {300, 300}, side, kChannels);
    const std::uint64_t said = MapFile::memory_bytes({300, 300}, side, kChannels.size());
    EXPECT_LE(most_held_bytes, said);
    for (const Tile tile : tiles_of(map)) {
      write(map, tile, side, random_bits);
      ASSERT_LE(held_bytes, said) << "it adds up";
    }
    EXPECT_LE(most_held_bytes, said + MapFile::write_bytes(side, kChannels.size()));
    map.commit();
    EXPECT_EQ(held_bytes, 0U);
  }
  exr_set_default_memory_routines(nullptr, nullptr);
}

}  // namespace
}  // namespace atlasgauge
