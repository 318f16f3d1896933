#include "stream/seams/tile_layout.hpp"

#include <gtest/gtest.h>

#include <cstdint>

namespace atlasgauge {
namespace {

void expect_tile(const ImageTile& tile, std::uint64_t first_page, std::uint32_t pages,
                 std::uint32_t width, std::uint32_t height) {
  EXPECT_EQ(tile.first_page, first_page);
  EXPECT_EQ(tile.pages, pages);
  EXPECT_EQ(tile.width, width);
  EXPECT_EQ(tile.height, height);
}

TEST(TileLayoutTest, BorderTilesAreAsSmallAsTheyAre) {
  const TileLayout layout({130, 70}, TexelKind::kByte);
  EXPECT_EQ(layout.columns(), 3U);
  EXPECT_EQ(layout.rows(), 2U);
  EXPECT_EQ(layout.tile_count(), 6U);
  expect_tile(layout.tile(0), 0, 3, 64, 64);  // 12288 bytes
  expect_tile(layout.tile(1), 3, 3, 64, 64);
  expect_tile(layout.tile(2), 6, 1, 2, 64);  // 384 bytes
  expect_tile(layout.tile(3), 7, 1, 64, 6);
  expect_tile(layout.tile(4), 8, 1, 64, 6);
  expect_tile(layout.tile(5), 9, 1, 2, 6);
  EXPECT_EQ(layout.page_count(), 10U);
}

TEST(TileLayoutTest, WholeTilesHaveNoBorder) {
  const TileLayout layout({128, 64}, TexelKind::kByte);
  EXPECT_EQ(layout.tile_count(), 2U);
  expect_tile(layout.tile(1), 3, 3, 64, 64);
  EXPECT_EQ(layout.page_count(), 6U);
}

TEST(TileLayoutTest, WiderTexelsTakeMorePages) {
  EXPECT_EQ(TileLayout({64, 64}, TexelKind::kShort).page_count(), 6U);
  EXPECT_EQ(TileLayout({64, 64}, TexelKind::kFloat).page_count(), 12U);
  EXPECT_EQ(TileLayout({1, 1}, TexelKind::kFloat).page_count(), 1U);
  EXPECT_EQ(TileLayout({}, TexelKind::kFloat).page_count(), 0U);
}

TEST(TileLayoutTest, BandIsTheRowsOfARowOfTiles) {
  EXPECT_EQ(TileLayout({130, 70}, TexelKind::kByte).band_bytes(), 130U * 64 * 3);
  EXPECT_EQ(TileLayout({130, 7}, TexelKind::kShort).band_bytes(), 130U * 7 * 6);
}

TEST(TileLayoutTest, TilesFollowEachOtherWithoutGaps) {
  for (const TexelKind kind : {TexelKind::kByte, TexelKind::kShort, TexelKind::kFloat}) {
    for (const ImageSize size :
         {ImageSize{1, 1}, ImageSize{1, 300}, ImageSize{300, 1}, ImageSize{63, 65},
          ImageSize{64, 128}, ImageSize{65, 129}, ImageSize{200, 333}}) {
      const TileLayout layout(size, kind);
      std::uint64_t pages = 0, texels = 0;
      for (std::uint64_t i = 0; i < layout.tile_count(); ++i) {
        const ImageTile tile = layout.tile(i);
        EXPECT_EQ(tile.first_page, pages) << size.width << " x " << size.height;
        EXPECT_GE(tile.pages * sizeof(TexelPage),
                  std::uint64_t{tile.width} * tile.height * texel_bytes(kind));
        pages += tile.pages;
        texels += std::uint64_t{tile.width} * tile.height;
      }
      EXPECT_EQ(layout.page_count(), pages);
      EXPECT_EQ(texels, std::uint64_t{size.width} * size.height);
    }
  }
}

TEST(TileLayoutTest, PagesAreCountedBeyond32Bits) {
  const TileLayout layout({1U << 22, 1U << 22}, TexelKind::kFloat);
  EXPECT_EQ(layout.tile_count(), std::uint64_t{1} << 32);
  EXPECT_EQ(layout.page_count(), std::uint64_t{12} << 32);
  EXPECT_EQ(layout.tile(layout.tile_count() - 1).first_page, (std::uint64_t{12} << 32) - 12);
  EXPECT_EQ(layout.band_bytes(), std::uint64_t{12 * 64} << 22);
}

}  // namespace
}  // namespace atlasgauge
