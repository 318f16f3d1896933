#include "io/image/png_file.hpp"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/image/image_module.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/module_folder.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes random_texels(ImageSize size) {
  std::mt19937 random(size.width);
  Bytes rgb(std::size_t{size.width} * size.height * 3);
  for (std::uint8_t& byte : rgb) byte = static_cast<std::uint8_t>(random());
  return rgb;
}

class PngFileTest : public testing::Test {
 protected:
  void SetUp() override { show_modules(kImageModuleFile); }

  ErrorKind error_kind(const std::string& path, ImageSize size, const Bytes& rgb) {
    try {
      write_png(path, size, rgb);
    } catch (const Error& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(path)) << error.what();
      return error.kind();
    }
    return ErrorKind{};
  }

  TempDir dir_;
  const std::string path_ = (dir_.path() / "a.png").string();
};

TEST_F(PngFileTest, BytesReadBackAsTheyAre) {
  for (const ImageSize size : {ImageSize{1, 1}, ImageSize{256, 3}, ImageSize{7, 500}}) {
    const Bytes rgb = random_texels(size);
    write_png(path_, size, rgb);
    const auto image = OIIO::ImageInput::open(path_);
    ASSERT_TRUE(image) << OIIO::geterror();
    EXPECT_STREQ(image->format_name(), "png");
    ASSERT_EQ(image->spec().width, static_cast<int>(size.width));
    ASSERT_EQ(image->spec().height, static_cast<int>(size.height));
    ASSERT_EQ(image->spec().nchannels, 3);
    ASSERT_EQ(image->spec().format, OIIO::TypeDesc::UINT8);
    Bytes read(rgb.size());
    ASSERT_TRUE(image->read_image(0, 0, 0, 3, OIIO::TypeDesc::UINT8, read.data()));
    EXPECT_EQ(read, rgb);
  }
}

TEST_F(PngFileTest, TheSameTexelsAreTheSameFile) {
  const Bytes rgb = random_texels({50, 50});
  write_png(path_, {50, 50}, rgb);
  const std::string first = content_of(path_);
  write_png(path_, {50, 50}, rgb);
  EXPECT_EQ(content_of(path_), first);
}

TEST_F(PngFileTest, FullDiskLeavesTheOldFile) {
  dir_.write("a.png", "old");
  {
    const FileSizeLimit limit(1000);
    EXPECT_EQ(error_kind(path_, {100, 100}, random_texels({100, 100})), ErrorKind::kResource);
  }
  EXPECT_EQ(error_kind("/dev/full", {10, 10}, random_texels({10, 10})), ErrorKind::kResource);
  EXPECT_EQ(content_of(path_), "old");
  EXPECT_EQ(names_in(dir_.path()).size(), 1U);
}

TEST_F(PngFileTest, TexelsThatDoNotFillTheImageAreRefused) {
  const Bytes rgb = random_texels({10, 10});
  EXPECT_EQ(error_kind(path_, {10, 11}, rgb), ErrorKind::kInternal);
  EXPECT_EQ(error_kind(path_, {10, 9}, rgb), ErrorKind::kInternal);
  EXPECT_EQ(error_kind(path_, {0, 10}, rgb), ErrorKind::kInternal);
  EXPECT_EQ(error_kind(path_, {0, 0}, {}), ErrorKind::kInternal);
  EXPECT_EQ(names_in(dir_.path()).size(), 0U);
}

}  // namespace
}  // namespace atlasgauge
