#include "io/image/image_reader.hpp"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "io/error.hpp"
#include "io/image/image_module.hpp"
#include "tests/support/module_folder.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

/// 3x2 texels as uncompressed Netpbm: a header and six bytes.
const std::string kGreyImage = "P5\n3 2\n255\nabcdef";

class ImageInfoTest : public ::testing::Test {
 protected:
  void SetUp() override { show_modules(kImageModuleFile); }

  std::string error_of(const std::string& path) {
    try {
      read_image_header({.path = path});
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.what();
    }
    return "";
  }

  TempDir dir_;
};

TEST_F(ImageInfoTest, ReadsTheSizeFromTheHeader) {
  const ImageSize size = read_image_header({.path = dir_.write("grey.pgm", kGreyImage)}).size;
  EXPECT_EQ(size.width, 3U);
  EXPECT_EQ(size.height, 2U);
}

TEST_F(ImageInfoTest, TheEndingOfTheNameDoesNotMatter) {
  EXPECT_EQ(read_image_header({.path = dir_.write("grey.png", kGreyImage)}).size.width, 3U);
  EXPECT_EQ(read_image_header({.path = dir_.write("grey", kGreyImage)}).size.width, 3U);
}

TEST_F(ImageInfoTest, ImagesThatCannotBeReadAreErrors) {
  EXPECT_NE(error_of(dir_.write("empty.png", "")), "");
  EXPECT_NE(error_of(dir_.write("text.jpg", "no image at all")), "");
  EXPECT_NE(error_of((dir_.path() / "none.png").string()), "");
  EXPECT_NE(error_of(dir_.path().string()), "");
}

TEST_F(ImageInfoTest, ImagesWithoutTexelsAreErrors) {
  EXPECT_NE(error_of(dir_.write("flat.pgm", "P5\n0 2\n255\n")), "");
}

TEST_F(ImageInfoTest, HeadersCutAnywhereAreSizesOrErrors) {
  for (std::size_t bytes = 0; bytes < kGreyImage.size(); ++bytes) {
    error_of(dir_.write("cut.pgm", kGreyImage.substr(0, bytes)));
  }
}

using Rgb = std::array<int, 3>;
using Settings = std::function<void(OIIO::ImageSpec&)>;

constexpr std::uint32_t kWidth = 37;
constexpr std::uint32_t kHeight = 23;

/// Differs between all texels and between the corners.
std::vector<std::uint8_t> gradient(std::uint32_t width = kWidth, std::uint32_t height = kHeight,
                                   int channels = 3) {
  std::vector<std::uint8_t> texels;
  for (std::uint32_t y = 0; y < height; ++y) {
    for (std::uint32_t x = 0; x < width; ++x) {
      const std::array<std::uint32_t, 4> texel = {x * 6, y * 9, (x ^ y) * 4, x * y};
      for (int c = 0; c < channels; ++c) {
        texels.push_back(static_cast<std::uint8_t>(texel[static_cast<std::size_t>(c)]));
      }
    }
  }
  return texels;
}

/// Red and green above, blue and white below: for formats with losses.
std::vector<std::uint8_t> quarters(std::uint32_t side) {
  std::vector<std::uint8_t> texels;
  for (std::uint32_t y = 0; y < side; ++y) {
    for (std::uint32_t x = 0; x < side; ++x) {
      const bool right = x >= side / 2;
      const bool below = y >= side / 2;
      texels.push_back(right == below ? 255 : 0);
      texels.push_back(right ? 255 : 0);
      texels.push_back(below ? 255 : 0);
    }
  }
  return texels;
}

template <class Component>
std::vector<Component> read_texels(const std::string& path, std::uint32_t band = 1U << 30) {
  const std::unique_ptr<ImageRows> rows = open_image({.path = path});
  const ImageSize size = rows->header().size;
  EXPECT_EQ(texel_bytes(rows->header().kind), 3 * sizeof(Component)) << path;
  if (texel_bytes(rows->header().kind) != 3 * sizeof(Component)) return {};
  std::vector<Component> texels(std::size_t{size.width} * size.height * 3);
  auto* to = reinterpret_cast<std::byte*>(texels.data());
  for (std::uint32_t y = 0; y < size.height; y += std::min(band, size.height - y)) {
    const std::uint32_t now = std::min(band, size.height - y);
    rows->read(now, to + std::size_t{y} * size.width * texel_bytes(rows->header().kind));
  }
  return texels;
}

std::vector<std::uint8_t> read_bytes(const std::string& path, std::uint32_t band = 1U << 30) {
  return read_texels<std::uint8_t>(path, band);
}

class ImageRowsTest : public ImageInfoTest {
 protected:
  template <class Component>
  std::string write(const std::string& name, std::uint32_t width, std::uint32_t height,
                    int channels, const std::vector<Component>& texels,
                    const Settings& settings = {}) {
    std::string path = (dir_.path() / name).string();
    OIIO::ImageSpec spec(static_cast<int>(width), static_cast<int>(height), channels,
                         OIIO::BaseTypeFromC<Component>::value);
    if (settings) settings(spec);
    const auto image = OIIO::ImageOutput::create(path);
    EXPECT_TRUE(image && image->open(path, spec)) << name << OIIO::geterror();
    EXPECT_TRUE(image->write_image(OIIO::BaseTypeFromC<Component>::value, texels.data()) &&
                image->close())
        << name << image->geterror();
    return path;
  }

  std::string write_gradient(const std::string& name, const Settings& settings = {}) {
    return write(name, kWidth, kHeight, 3, gradient(), settings);
  }

  std::string content(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  std::string error_of_rows(const std::string& path) {
    try {
      const std::unique_ptr<ImageRows> rows = open_image({.path = path});
      const ImageHeader& header = rows->header();
      std::vector<std::byte> row(std::size_t{header.size.width} * texel_bytes(header.kind));
      for (std::uint32_t y = 0; y < header.size.height; ++y) rows->read(1, row.data());
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.what();
    }
    return "";
  }
};

std::string from_hex(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  }
  return bytes;
}

Settings compressed(const std::string& how) {
  return [how](OIIO::ImageSpec& spec) { spec.attribute("compression", how); };
}

Settings in_strips(const std::string& how, int rows) {
  return [=](OIIO::ImageSpec& spec) {
    spec.attribute("compression", how);
    spec.attribute("tiff:RowsPerStrip", rows);
  };
}

Settings in_tiles(const std::string& how, int side) {
  return [=](OIIO::ImageSpec& spec) {
    spec.attribute("compression", how);
    spec.tile_width = spec.tile_height = side;
  };
}

Settings with(const std::string& name, int value) {
  return [=](OIIO::ImageSpec& spec) { spec.attribute(name, value); };
}

TEST_F(ImageRowsTest, FormatsWithoutLossGiveTheTexelsFromTheTopRowDown) {
  for (const char* name : {"a.png", "a.tif", "a.tga", "a.bmp", "a.ppm", "a.sgi", "a.rla"}) {
    EXPECT_EQ(read_bytes(write_gradient(name)), gradient()) << name;
  }
}

TEST_F(ImageRowsTest, FormatsWithLossesGiveTheCornersInTheirPlaces) {
  constexpr std::uint32_t kSide = 32;
  for (const char* name : {"a.jpg", "a.webp", "a.gif", "a.jp2"}) {
    const std::vector<std::uint8_t> texels =
        read_bytes(write(name, kSide, kSide, 3, quarters(kSide)));
    const std::vector<std::uint8_t> expected = quarters(kSide);
    for (const std::uint32_t y : {2U, kSide - 3}) {
      for (const std::uint32_t x : {2U, kSide - 3}) {
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t at = (std::size_t{y} * kSide + x) * 3 + c;
          EXPECT_NEAR(texels[at], expected[at], 40) << name << " at " << x << ", " << y;
        }
      }
    }
  }
}

TEST_F(ImageRowsTest, BandsOfAnyHeightGiveTheSameRows) {
  const std::vector<std::string> paths = {
      write_gradient("a.png"),
      write_gradient("a.jpg"),
      write_gradient("p.jpg", with("jpeg:progressive", 1)),
      write_gradient("a.tga"),
      write_gradient("a.bmp"),
      write_gradient("a.webp"),
      write_gradient("a.gif"),
      write_gradient("s.tif", in_strips("zip", 5)),
      write_gradient("t.tif", in_tiles("zip", 16)),
  };
  for (const std::string& path : paths) {
    const std::vector<std::uint8_t> whole = read_bytes(path);
    for (const std::uint32_t band : {1U, 2U, 7U, 16U, kHeight - 1, kHeight}) {
      EXPECT_EQ(read_bytes(path, band), whole) << path << " by " << band;
    }
  }
}

TEST_F(ImageRowsTest, MoreRowsThanThereAreAreAnError) {
  const std::unique_ptr<ImageRows> rows = open_image({.path = write_gradient("a.png")});
  std::vector<std::byte> to(std::size_t{kWidth} * 3 * (kHeight + 1));
  EXPECT_THROW(rows->read(kHeight + 1, to.data()), Error);
}

TEST_F(ImageRowsTest, ThreadsReadDifferentImages) {
  const std::string png = write_gradient("a.png");
  const std::string tiff = write_gradient("a.tif", in_strips("zip", 4));
  const auto read_often = [](const std::string& path) {
    for (int i = 0; i < 20; ++i) EXPECT_EQ(read_bytes(path, 3), gradient());
  };
  std::thread other([&] { read_often(png); });
  read_often(tiff);
  other.join();
}

TEST_F(ImageRowsTest, GreyIsInAllThree) {
  const std::string path = dir_.write("grey.pgm", kGreyImage);
  const std::vector<std::uint8_t> expected = {'a', 'a', 'a', 'b', 'b', 'b', 'c', 'c', 'c',
                                              'd', 'd', 'd', 'e', 'e', 'e', 'f', 'f', 'f'};
  EXPECT_EQ(read_bytes(path), expected);
}

TEST_F(ImageRowsTest, GreyWithAlphaIsGreyAsStored) {
  const std::vector<std::uint8_t> texels = {200, 0, 100, 128};
  const auto stored = with("oiio:UnassociatedAlpha", 1);
  for (const char* name : {"ya.png", "ya.tif"}) {
    EXPECT_EQ(read_bytes(write(name, 2, 1, 2, texels, stored)),
              (std::vector<std::uint8_t>{200, 200, 200, 100, 100, 100}))
        << name;
  }
}

TEST_F(ImageRowsTest, ColoursUnderAlphaAreAsStored) {
  const std::vector<std::uint8_t> texels = {250, 120, 30, 0, 250, 120, 30, 100};
  const std::vector<std::uint8_t> expected = {250, 120, 30, 250, 120, 30};
  const auto stored = with("oiio:UnassociatedAlpha", 1);
  for (const char* name : {"a.png", "a.tif", "a.tga", "a.bmp", "a.sgi"}) {
    EXPECT_EQ(read_bytes(write(name, 2, 1, 4, texels, stored)), expected) << name;
  }
}

TEST_F(ImageRowsTest, WebpIsReadWhereItIsOpaque) {
  std::vector<std::uint8_t> texels;
  for (int i = 0; i < 64; ++i) texels.insert(texels.end(), {250, 120, 30, 255});
  const std::vector<std::uint8_t> read = read_bytes(write("a.webp", 8, 8, 4, texels));
  ASSERT_EQ(read.size(), 3U * 64);
  EXPECT_NEAR(read[0], 250, 5);
  texels.back() = 0;
  EXPECT_NE(error_of_rows(write("b.webp", 8, 8, 4, texels)).find("transparent"), std::string::npos);
}

TEST_F(ImageRowsTest, GifIsReadWhereItIsOpaque) {
  // One texel of two colours, of which the first is transparent in the second image.
  const std::string head = from_hex(
      "474946383961"
      "01000100"
      "800000"
      "0a141e"
      "ffffff");
  const std::string texel = from_hex(
      "2c00000000"
      "01000100"
      "00"
      "02"
      "02"
      "4401"
      "00"
      "3b");
  EXPECT_EQ(read_bytes(dir_.write("a.gif", head + texel)), (std::vector<std::uint8_t>{10, 20, 30}));
  const std::string transparent = from_hex(
      "21f904"
      "01000000"
      "00");
  const std::string path = dir_.write("b.gif", head + transparent + texel);
  EXPECT_NE(error_of_rows(path).find("transparent"), std::string::npos);
}

TEST_F(ImageRowsTest, TargaByHandWithAlphaIsAsStored) {
  // From the bottom row up, as is usual: blue, green, red, alpha.
  const std::string head("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\2\0\x20\x08", 18);
  const std::string below("\x0a\x14\x1e\x00", 4);
  const std::string above("\x28\x32\x3c\x80", 4);
  EXPECT_EQ(read_bytes(dir_.write("a.tga", head + below + above)),
            (std::vector<std::uint8_t>{60, 50, 40, 30, 20, 10}));
}

TEST_F(ImageRowsTest, BitmapByHandWithAPaletteIsExpanded) {
  // Two rows of one index, each filled up to four bytes; colours are blue, green, red, 0.
  const std::string file_head("BM\x46\0\0\0\0\0\0\0\x3e\0\0\0", 14);
  const std::string head("\x28\0\0\0\1\0\0\0\2\0\0\0\1\0\x08\0\0\0\0\0\x08\0\0\0", 24);
  const std::string counts("\0\0\0\0\0\0\0\0\2\0\0\0\2\0\0\0", 16);
  const std::string colours("\1\2\3\0\4\5\6\0", 8);
  const std::string rows("\1\0\0\0\0\0\0\0", 8);
  EXPECT_EQ(read_bytes(dir_.write("a.bmp", file_head + head + counts + colours + rows)),
            (std::vector<std::uint8_t>{3, 2, 1, 6, 5, 4}));
}

TEST_F(ImageRowsTest, SixteenBitsAreKept) {
  const std::vector<std::uint16_t> texels = {0, 1, 65535, 256, 257, 40000};
  for (const char* name : {"a.png", "a.tif"}) {
    EXPECT_EQ(read_image_header({.path = write(name, 2, 1, 3, texels)}).kind, TexelKind::kShort)
        << name;
    EXPECT_EQ(read_texels<std::uint16_t>((dir_.path() / name).string()), texels) << name;
  }
}

TEST_F(ImageRowsTest, SixteenBitNetpbmByHand) {
  const std::string path =
      dir_.write("a.ppm", std::string("P6\n# texels\n1 1\n65535\n\x01\x02\x03\x04\x05\x06"));
  EXPECT_EQ(read_texels<std::uint16_t>(path), (std::vector<std::uint16_t>{0x102, 0x304, 0x506}));
}

TEST_F(ImageRowsTest, FloatsAreKept) {
  const std::vector<float> texels = {-1.5F, 0.F, 0.25F, 1.F, 1e6F, 1e-6F};
  for (const char* name : {"a.exr", "a.tif"}) {
    EXPECT_EQ(read_texels<float>(write(name, 2, 1, 3, texels)), texels) << name;
  }
}

TEST_F(ImageRowsTest, HalfFloatsAreFloats) {
  const std::vector<float> texels = {-1.5F, 0.F, 0.25F, 1.F, 1024.F, 0.125F};
  const auto half = [](OIIO::ImageSpec& spec) { spec.set_format(OIIO::TypeDesc::HALF); };
  EXPECT_EQ(read_texels<float>(write("a.exr", 2, 1, 3, texels, half)), texels);
}

TEST_F(ImageRowsTest, FloatNetpbmIsFromTheTopDownToo) {
  const std::array<float, 6> texels = {1.F, 2.F, 3.F, 4.F, 5.F, 6.F};  // the lower row first
  std::string bytes(sizeof texels, '\0');
  std::memcpy(bytes.data(), texels.data(), sizeof texels);
  EXPECT_EQ(read_texels<float>(dir_.write("a.pfm", "PF\n1 2\n-1.0\n" + bytes)),
            (std::vector<float>{4.F, 5.F, 6.F, 1.F, 2.F, 3.F}));
}

TEST_F(ImageRowsTest, ChannelsAreFoundByTheirNames) {
  const std::vector<float> texels = {9.F, 3.F, 8.F, 2.F, 1.F};
  const auto named = [](OIIO::ImageSpec& spec) { spec.channelnames = {"Z", "B", "U", "G", "R"}; };
  EXPECT_EQ(read_texels<float>(write("a.exr", 1, 1, 5, texels, named)),
            (std::vector<float>{1.F, 2.F, 3.F}));
  const auto layers = [](OIIO::ImageSpec& spec) {
    spec.channelnames = {"a.R", "B", "G", "R", "z.depth"};
  };
  EXPECT_EQ(read_texels<float>(write("b.exr", 1, 1, 5, texels, layers)),
            (std::vector<float>{2.F, 8.F, 3.F}));
}

TEST_F(ImageRowsTest, ChannelsAreFoundInTilesToo) {
  std::vector<float> texels;
  std::vector<float> expected;
  for (int i = 0; i < 20 * 19; ++i) {
    const auto value = static_cast<float>(i);
    texels.insert(texels.end(), {-1.F, value + 2, -2.F, value + 1, value});
    expected.insert(expected.end(), {value, value + 1, value + 2});
  }
  const auto named = [](OIIO::ImageSpec& spec) {
    spec.channelnames = {"Z", "B", "U", "G", "R"};
    spec.tile_width = spec.tile_height = 16;
  };
  const std::string path = write("a.exr", 20, 19, 5, texels, named);
  EXPECT_EQ(read_texels<float>(path), expected);
  EXPECT_EQ(read_texels<float>(path, 5), expected);
}

TEST_F(ImageRowsTest, TheDataWindowIsTheImage) {
  const std::vector<float> texels = {1.F, 2.F, 3.F, 4.F, 5.F, 6.F};
  const auto moved = [](OIIO::ImageSpec& spec) {
    spec.x = -7;
    spec.y = -3;
    spec.full_width = spec.full_height = 100;
  };
  EXPECT_EQ(read_texels<float>(write("a.exr", 1, 2, 3, texels, moved)), texels);
  const auto in_tiles = [&](OIIO::ImageSpec& spec) {
    moved(spec);
    spec.tile_width = spec.tile_height = 16;
  };
  EXPECT_EQ(read_texels<float>(write("t.exr", 1, 2, 3, texels, in_tiles)), texels);
}

TEST_F(ImageRowsTest, CompressionsOfOpenExrGiveTheSame) {
  const std::vector<std::uint8_t> bytes = gradient();
  const std::vector<float> texels(bytes.begin(), bytes.end());
  for (const char* how : {"none", "rle", "zips", "zip", "piz"}) {
    const std::string name = std::string(how) + ".exr";
    const std::string path = write("s_" + name, kWidth, kHeight, 3, texels, compressed(how));
    EXPECT_EQ(read_texels<float>(path, 3), texels) << name;
    const std::string tiled = write("t_" + name, kWidth, kHeight, 3, texels, in_tiles(how, 8));
    EXPECT_EQ(read_texels<float>(tiled, 3), texels) << name;
  }
}

TEST_F(ImageRowsTest, StripsAndTilesOfTiffGiveTheSame) {
  const auto separate = [](OIIO::ImageSpec& spec) { spec.attribute("planarconfig", "separate"); };
  EXPECT_EQ(read_bytes(write_gradient("p.tif", separate), 3), gradient());
  for (const char* how : {"none", "lzw", "zip", "packbits"}) {
    for (const int rows : {1, 5, 1000}) {
      const std::string name = how + std::to_string(rows) + ".tif";
      EXPECT_EQ(read_bytes(write_gradient(name, in_strips(how, rows)), 3), gradient()) << name;
    }
    const std::string name = std::string(how) + ".tif";
    EXPECT_EQ(read_bytes(write_gradient(name, in_tiles(how, 16)), 3), gradient()) << name;
  }
}

TEST_F(ImageRowsTest, ProgressiveJpegGivesTheRowsOfTheBaselineOne) {
  EXPECT_EQ(read_bytes(write_gradient("p.jpg", with("jpeg:progressive", 1)), 5),
            read_bytes(write_gradient("b.jpg"), 5));
}

/// A table of quantization without loss.
const std::string kOnes = from_hex(
    "0101010101010101010101010101010101010101010101010101010101010101"
    "0101010101010101010101010101010101010101010101010101010101010101");

/// 8x8 texels of cyan 200, magenta 100, yellow 50, black 128, of 255 where there is no ink.
std::string cmyk_jpeg() {
  return from_hex("ffd8ffee000e41646f626500640000000000ffdb004300") + kOnes +
         from_hex(
             "ffc000140800080008044311004d11005911004b1100ffc40016000101010000000000000000"
             "00000000000a0008ffc40014100100000000000000000000000000000000ffda000e04430"
             "04d0059004b00003f00480c3e31e9ffd9");
}

/// 8x8 texels of red 200, green 100, blue 50: Y, Cb and Cr in a scan each.
std::string jpeg_of_three_scans() {
  const std::string table = "100100000000000000000000000000000000";
  return from_hex("ffd8ffe000104a46494600010100000100010000ffdb004300") + kOnes +
         from_hex("ffdb004301") + kOnes +
         from_hex(
             "ffc00011080008000803011100021101031101ffc4001400010000000000000000000000000000"
             "0006ffc40014" +
             table +
             "ffda0008010100003f003eff"
             "c40014010100000000000000000000000000000009ffc400141101000000000000000000000000"
             "00000000ffda0008010211003f002bdfffc40014010100000000000000000000000000000009"
             "ffc4001411010000000000000000000000000000"
             "0000ffda0008010311003f006c1fffd9");
}

void expect_all(const std::vector<std::uint8_t>& texels, Rgb expected) {
  for (std::size_t i = 0; i < texels.size(); ++i) {
    ASSERT_NEAR(texels[i], expected[i % 3], 2) << i;
  }
}

TEST_F(ImageRowsTest, InksOfJpegBecomeColours) {
  // Each ink and black let light through one after the other: 200 x 128 / 255 and so on.
  expect_all(read_bytes(dir_.write("cmyk.jpg", cmyk_jpeg())), {100, 50, 25});
}

TEST_F(ImageRowsTest, JpegOfSeveralScansIsReadAndHeld) {
  const std::string path = dir_.write("scans.jpg", jpeg_of_three_scans());
  expect_all(read_bytes(path), {200, 100, 50});
}

TEST_F(ImageRowsTest, FilesCutAnywhereFailOrGiveTheSame) {
  const std::vector<std::string> paths = {
      write_gradient("a.png"),
      write_gradient("a.jpg"),
      write_gradient("p.jpg", with("jpeg:progressive", 1)),
      write_gradient("a.tif", in_strips("none", 5)),
      write_gradient("z.tif", in_strips("zip", 5)),
      write_gradient("a.bmp"),
      write_gradient("a.tga"),
      write_gradient("r.tga", compressed("rle")),
      write_gradient("a.ppm"),
      write_gradient("a.webp"),
  };
  for (const std::string& path : paths) {
    const std::vector<std::uint8_t> whole = read_bytes(path);
    const std::string bytes = content(path);
    for (std::size_t cut = 0; cut < bytes.size(); cut += 1 + bytes.size() / 50) {
      const std::string shorter = dir_.write("cut", bytes.substr(0, cut));
      if (!error_of_rows(shorter).empty()) continue;
      EXPECT_EQ(read_bytes(shorter), whole) << path << " at " << cut;
    }
  }
}

TEST_F(ImageRowsTest, OpenExrCutAnywhereFails) {
  const std::vector<std::uint8_t> bytes = gradient();
  const std::vector<float> texels(bytes.begin(), bytes.end());
  const std::string file = content(write("a.exr", kWidth, kHeight, 3, texels));
  for (std::size_t cut = 0; cut < file.size(); cut += 1 + file.size() / 50) {
    EXPECT_NE(error_of_rows(dir_.write("cut.exr", file.substr(0, cut))), "") << cut;
  }
}

TEST_F(ImageRowsTest, FilesThatAreNoImagesCannotBeOpened) {
  EXPECT_THROW(open_image({.path = dir_.write("empty.png", "")}), Error);
  EXPECT_THROW(open_image({.path = dir_.write("text.jpg", "no image at all")}), Error);
  EXPECT_THROW(open_image({.path = (dir_.path() / "none.png").string()}), Error);
  EXPECT_THROW(open_image({.path = dir_.path().string()}), Error);
  EXPECT_THROW(open_image({.path = (dir_.path() / "none.null").string()}), Error);
}

TEST_F(ImageRowsTest, HeadersThatTheLibraryWouldCrashOnAreErrors) {
  std::string bitmap = content(write_gradient("a.bmp"));
  bitmap[30] = '\2';  // run lengths of four bits, of texels of 24
  const auto refused_unopened = [&](const std::string& path) {
    return error_of_rows(path).find("its header contradicts itself") != std::string::npos;
  };
  EXPECT_TRUE(refused_unopened(dir_.write("b.bmp", bitmap)));
  std::string sgi = content(write_gradient("a.sgi"));
  sgi[3] = '\0';  // bytes a channel
  EXPECT_TRUE(refused_unopened(dir_.write("b.sgi", sgi)));
}

class DecoderBytesTest : public ImageRowsTest {
 protected:
  static constexpr std::uint32_t kSide = 2048;
  static constexpr std::uint64_t kTexels = std::uint64_t{kSide} * kSide;
  static constexpr std::uint64_t kLittle = 10 << 20;

  std::uint64_t bytes_of(const std::string& path) {
    return read_image_header({.path = path}).decoder_bytes;
  }

  std::string write_black(const std::string& name, const Settings& settings = {}) {
    return write(name, kSide, kSide, 3, std::vector<std::uint8_t>(kTexels * 3), settings);
  }
};

TEST_F(DecoderBytesTest, AreLittleForImagesInRows) {
  for (const char* name : {"a.png", "a.jpg", "a.bmp", "a.tif"}) {
    EXPECT_LT(bytes_of(write_black(name)), kLittle) << name;
  }
}

TEST_F(DecoderBytesTest, AreTheCoefficientsOfProgressiveJpeg) {
  // Two bytes each of a value a texel and two at half the width and height.
  const auto progressive = with("jpeg:progressive", 1);
  EXPECT_GT(bytes_of(write_black("p.jpg", progressive)), 3 * kTexels);
  EXPECT_LT(bytes_of(write_black("p.jpg", progressive)), 3 * kTexels + kLittle);
}

TEST_F(DecoderBytesTest, AreTheTexelsWhereTheyAreHeld) {
  EXPECT_GT(bytes_of(write_black("a.tga")), 3 * kTexels);
  EXPECT_GT(bytes_of(write_black("a.gif")), 4 * kTexels);
  EXPECT_GT(bytes_of(write_black("a.webp")), 3 * kTexels);
}

/// The signature and header of a PNG file, with its checksum.
std::string png_head(bool interlaced, std::uint32_t checksum) {
  std::string head = from_hex(
      "89504e470d0a1a0a0000000d49484452"
      "000186a0"
      "000186a0"
      "0802000000");
  head.back() = interlaced ? '\1' : '\0';
  for (int shift = 24; shift >= 0; shift -= 8) head += static_cast<char>(checksum >> shift & 0xff);
  return head + from_hex(
                    "00000000"
                    "49444154"
                    "35af061e");
}

TEST_F(DecoderBytesTest, AreTheTexelsOfInterlacedPngWithoutHoldingThem) {
  const std::uint64_t texels = std::uint64_t{100000} * 100000;
  const std::string plain = dir_.write("plain.png", png_head(false, 0x27309c9f));
  EXPECT_LT(bytes_of(plain), kLittle);
  EXPECT_NE(error_of_rows(plain), "");
  EXPECT_GT(bytes_of(dir_.write("adam7.png", png_head(true, 0x5037ac09))), 3 * texels);
}

TEST_F(DecoderBytesTest, AreToldForHeadersThatPromiseMuch) {
  const std::string gif = from_hex("474946383961ffffffff000000");
  EXPECT_GT(bytes_of(dir_.write("a.gif", gif)), std::uint64_t{4} * 65535 * 65535);
  const std::string netpbm = "P6\n2000000000 2000000000\n255\n";
  EXPECT_EQ(read_image_header({.path = dir_.write("a.ppm", netpbm)}).size.width, 2000000000U);
}

TEST_F(DecoderBytesTest, OpenExrShorterThanItsTablesIsAnError) {
  std::string file = content(write("a.exr", 2, 2, 3, std::vector<float>(12)));
  const std::string name("dataWindow\0box2i\0\x10\0\0\0", 21);
  const std::size_t window = file.find(name);
  ASSERT_NE(window, std::string::npos);
  file.replace(window + name.size() + 12, 4, std::string("\xff\xff\xff\x0f", 4));
  EXPECT_NE(error_of(dir_.write("a.exr", file)).find("more rows"), std::string::npos);
}

}  // namespace
}  // namespace atlasgauge
