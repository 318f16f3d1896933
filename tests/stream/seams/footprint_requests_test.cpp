#include "stream/seams/footprint_requests.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <ostream>
#include <vector>

namespace atlasgauge {
namespace {

StoredImage image_of(ImageSize size, TexelKind kind = TexelKind::kByte) {
  StoredImage image;
  image.decoded = true;
  image.kind = kind;
  image.size = size;
  image.layout = TileLayout(size, kind);
  image.first_tile = 100;
  return image;
}

struct Asked {
  std::uint32_t tile;
  unsigned corners, column, row;
  bool operator==(const Asked&) const = default;
};

void PrintTo(const Asked& asked, std::ostream* to) {
  *to << "tile " << asked.tile << ", corners " << asked.corners << ", column " << asked.column
      << ", row " << asked.row;
}

std::vector<Asked> requests_of(const StoredImage& image, std::int64_t x, std::int64_t y) {
  std::vector<Asked> asked;
  request_footprint(image, Footprint{x, y, 0, 0}, FootprintPart{}, [&](const TexelRequest& r) {
    asked.push_back({r.tile, r.part.corners, r.part.column, r.part.row});
  });
  return asked;
}

// Corners 1, 2, 4 and 8 are those at (x, y), (x + 1, y), (x, y + 1) and (x + 1, y + 1), v up. Rows
// of tiles are counted from the top.

TEST(FootprintRequestsTest, FootprintWithinATileIsOneRequest) {
  // Rows 127 - 100 and 127 - 101 of 128.
  EXPECT_EQ(requests_of(image_of({128, 128}), 70, 100), (std::vector<Asked>{{101, 15, 6, 27}}));
}

TEST(FootprintRequestsTest, FootprintAcrossATileBorderIsTwoRequests) {
  EXPECT_EQ(requests_of(image_of({128, 128}), 63, 100),
            (std::vector<Asked>{{100, 1 | 4, 63, 27}, {101, 2 | 8, 0, 27}}));
  // Row 127 - 63 is the first one of the lower tiles.
  EXPECT_EQ(requests_of(image_of({128, 128}), 5, 63),
            (std::vector<Asked>{{102, 1 | 2, 5, 0}, {100, 4 | 8, 5, 63}}));
}

TEST(FootprintRequestsTest, FootprintAcrossACornerIsFourRequests) {
  EXPECT_EQ(
      requests_of(image_of({128, 128}), 63, 63),
      (std::vector<Asked>{{102, 1, 63, 0}, {103, 2, 0, 0}, {100, 4, 63, 63}, {101, 8, 0, 63}}));
}

TEST(FootprintRequestsTest, FootprintAcrossTheBorderOfTheImageGoesOnAtTheOther) {
  EXPECT_EQ(requests_of(image_of({50, 40}), 49, 7),
            (std::vector<Asked>{{100, 1 | 4, 49, 32}, {100, 2 | 8, 0, 32}}));
  EXPECT_EQ(requests_of(image_of({50, 40}), 7, -1),
            (std::vector<Asked>{{100, 1 | 2, 7, 0}, {100, 4 | 8, 7, 39}}));
}

TEST(FootprintRequestsTest, NarrowImagesRepeatWithinAFootprint) {
  EXPECT_EQ(requests_of(image_of({1, 40}), 12345, 7),
            (std::vector<Asked>{{100, 1 | 4, 0, 32}, {100, 2 | 8, 0, 32}}));
  EXPECT_EQ(requests_of(image_of({1, 1}), -3, 9),
            (std::vector<Asked>{{100, 1, 0, 0}, {100, 2, 0, 0}, {100, 4, 0, 0}, {100, 8, 0, 0}}));
  EXPECT_EQ(requests_of(image_of({2, 1}), 1, 0),
            (std::vector<Asked>{{100, 1, 1, 0}, {100, 2, 0, 0}, {100, 4, 1, 0}, {100, 8, 0, 0}}));
}

TEST(FootprintRequestsTest, TexelsOfMoreThanAByteAreAskedForOneByOne) {
  for (const TexelKind kind : {TexelKind::kShort, TexelKind::kFloat}) {
    EXPECT_EQ(
        requests_of(image_of({128, 128}, kind), 70, 100),
        (std::vector<Asked>{{101, 1, 6, 27}, {101, 2, 7, 27}, {101, 4, 6, 26}, {101, 8, 7, 26}}));
  }
}

TEST(FootprintRequestsTest, CoordinatesRepeatAnyNumberOfTimes) {
  for (const std::int64_t periods : {-1'000'000'001, -2, -1, 0, 1, 1'000'000'001}) {
    const std::int64_t x = 7 * periods;
    EXPECT_EQ(repeated(x + 3, 7), 3) << x;
    EXPECT_EQ(repeated(x, 7), 0) << x;
  }
}

TEST(FootprintRequestsTest, AnswersHoldTheTexelsAskedFor) {
  const StoredImage image = image_of({64, 64});
  std::vector<std::uint8_t> texels(std::size_t{64} * 64 * 3);
  const auto texel = [&](std::size_t column, std::size_t row) {
    return texels.data() + (row * 64 + column) * 3;
  };
  for (std::size_t row = 0; row < 64; ++row) {
    for (std::size_t column = 0; column < 64; ++column) {
      texel(column, row)[0] = static_cast<std::uint8_t>(column);
      texel(column, row)[1] = static_cast<std::uint8_t>(row);
    }
  }
  const LoadedTile tile{&image, image.layout.tile(0),
                        reinterpret_cast<const std::byte*>(texels.data())};
  request_footprint(image, Footprint{10, 20, 0, 0}, FootprintPart{}, [&](const TexelRequest& r) {
    const TexelAnswer answer = answer_to(r, tile);
    EXPECT_EQ(answer.part.corners, 15);
    for (std::size_t c = 0; c < 4; ++c) {
      EXPECT_EQ(answer.texels[3 * c], 10 + c % 2);
      EXPECT_EQ(answer.texels[3 * c + 1], 63 - 20 - c / 2);
    }
  });
  // Two of its corners come from the other border: here those at the left, there those at the
  // right.
  std::vector<TexelAnswer> halves;
  request_footprint(image, Footprint{63, 20, 0, 0}, FootprintPart{},
                    [&](const TexelRequest& r) { halves.push_back(answer_to(r, tile)); });
  ASSERT_EQ(halves.size(), 2U);
  EXPECT_EQ(halves[0].texels[0], 63);
  EXPECT_EQ(halves[0].texels[6], 63);
  EXPECT_EQ(halves[1].texels[3 + 1], 43);
  EXPECT_EQ(halves[1].texels[9 + 1], 42);
}

TEST(FootprintRequestsTest, SamplesOnTheSameTexelsAskOnce) {
  // 20 samples on four texels, the centres of which begin and end a footprint.
  const SeamPath path({10, 20.5}, {14, 20.5}, 20, 0.5);
  std::vector<std::uint64_t> indices;
  request_path(image_of({64, 64}), path, 20, FootprintPart{},
               [&](const TexelRequest& r) { indices.push_back(r.part.index()); });
  EXPECT_EQ(indices, (std::vector<std::uint64_t>{0, 1, 2, 3, 4}));
}

TEST(FootprintRequestsTest, TexelsThatComeBackAreAskedForAgain) {
  const SeamPath path({0.5, 0.5}, {8.5, 0.5}, 8, 0.5);  // twice around four texels
  std::vector<std::uint64_t> indices;
  request_path(image_of({4, 4}), path, 8, FootprintPart{}, [&](const TexelRequest& r) {
    if ((r.part.corners & 1) != 0) indices.push_back(r.part.index());
  });
  std::vector<std::uint64_t> all(8);
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(indices, all);
}

}  // namespace
}  // namespace atlasgauge
