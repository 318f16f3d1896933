#include "stream/seams/texel_store.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <tuple>
#include <utility>
#include <vector>

#include "io/error.hpp"
#include "io/warnings.hpp"
#include "stream/seams/decode.hpp"
#include "tests/stream/seams/memory_textures.hpp"
#include "tests/support/engine_fixture.hpp"

namespace atlasgauge {
namespace {

TexelStore decoded(TestEngine& engine, const MemoryTextures& textures) {
  Warnings warnings([](const std::string& text) { ADD_FAILURE() << text; });
  const std::vector<bool> all(textures.size(), true);
  return decode_images(engine, textures.slots(), all,
                       {.model = "model.obj", .open_image = textures.open()}, warnings);
}

/// A component as it is stored.
double component(const std::byte* texel, TexelKind kind, int channel) {
  if (kind == TexelKind::kByte) return std::to_integer<int>(texel[channel]);
  if (kind == TexelKind::kShort) {
    std::uint16_t value = 0;
    std::memcpy(&value, texel + channel * 2, sizeof value);
    return value;
  }
  float value = 0;
  std::memcpy(&value, texel + channel * 4, sizeof value);
  return value;
}

void expect_texels(const TexelStore& store, SlotId slot, const MemoryImage& want,
                   TileCache& tiles) {
  const StoredImage& image = store.image(slot);
  const auto [width, height] = want.header.size;
  for (std::uint32_t row = 0; row < height; ++row) {
    for (std::uint32_t column = 0; column < width; ++column) {
      const std::uint32_t tile = image.first_tile + row / 64 * ((width + 63) / 64) + column / 64;
      const LoadedTile& loaded = tiles.at(tile);
      ASSERT_EQ(loaded.image, &image);
      const std::byte* texel = loaded.texel(column % 64, row % 64);
      for (int channel = 0; channel < 3; ++channel) {
        ASSERT_EQ(component(texel, want.header.kind, channel), want.component(column, row, channel))
            << width << " x " << height << ", " << column << ", " << row;
      }
    }
  }
}

/// Block size, bytes of the resident pool, workers.
using Shape = std::tuple<std::size_t, std::uint64_t, std::size_t>;
class TexelStoreTest : public testing::TestWithParam<Shape> {};

TEST_P(TexelStoreTest, EveryTexelIsAtItsPlace) {
  const auto [block_bytes, resident_bytes, workers] = GetParam();
  TestEngine engine(
      {.block_bytes = block_bytes, .workers = workers, .resident_bytes = resident_bytes});
  MemoryTextures textures;
  for (const TexelKind kind : {TexelKind::kByte, TexelKind::kShort, TexelKind::kFloat}) {
    for (const ImageSize size : {ImageSize{1, 1}, ImageSize{64, 64}, ImageSize{65, 63},
                                 ImageSize{131, 77}, ImageSize{3, 200}}) {
      textures.add(distinct_texels(size, kind));
    }
  }
  const TexelStore store = decoded(engine, textures);
  EXPECT_EQ(store.tile_count(), 3U * (1 + 1 + 2 + 6 + 4));
  for (const std::size_t cached : {1, 5}) {
    TileCache tiles(store, cached);
    for (std::uint32_t slot = 0; slot < textures.size(); ++slot) {
      expect_texels(store, SlotId{slot}, textures.image(SlotId{slot}), tiles);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, TexelStoreTest,
                         testing::Combine(testing::Values(4096, 12288, 65536),
                                          testing::Values(0, 200'000, 32 << 20),
                                          testing::Values(1, 3)));

TEST(TileCacheTest, TilesOfOnePlaceReplaceEachOther) {
  TestEngine engine;
  MemoryTextures textures;
  textures.add(distinct_texels({300, 10}, TexelKind::kByte));
  const TexelStore store = decoded(engine, textures);
  TileCache tiles(store, 2);
  for (const std::uint32_t tile : {0U, 2U, 0U, 1U, 4U, 0U, 0U, 3U, 1U}) {
    EXPECT_EQ(component(tiles.at(tile).texel(5, 6), TexelKind::kByte, 1),
              textures.image(SlotId{0}).component(64 * tile + 5, 6, 1));
  }
}

TEST(TexelStoreLimitsTest, TilesAreNumberedFromImageToImage) {
  std::vector<StoredImage> images(3);
  for (const std::size_t i : {0U, 2U}) {
    images[i].decoded = true;
    images[i].layout = TileLayout({100, 100}, TexelKind::kByte);
  }
  const TexelStore store(std::move(images), {});
  EXPECT_EQ(store.tile_count(), 8U);
  EXPECT_EQ(store.image(SlotId{2}).first_tile, 4U);
}

TEST(TexelStoreLimitsTest, MoreTilesThanNumbersAreRefused) {
  std::vector<StoredImage> images(2);
  for (StoredImage& image : images) {
    image.decoded = true;
    image.layout = TileLayout({1U << 22, 1U << 21}, TexelKind::kByte);
  }
  EXPECT_THROW(TexelStore(images, {}), Error);
  images.pop_back();
  EXPECT_EQ(TexelStore(images, {}).tile_count(), 1U << 31);
}

}  // namespace
}  // namespace atlasgauge
