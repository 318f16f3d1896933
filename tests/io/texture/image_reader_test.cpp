#include "io/texture/image_reader.hpp"

#include <gtest/gtest.h>

#include <string>

#include "io/error.hpp"
#include "io/texture/image_module.hpp"
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
      read_image_header(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInput);
      return error.what();
    }
    return "";
  }

  TempDir dir_;
};

TEST_F(ImageInfoTest, ReadsTheSizeFromTheHeader) {
  const ImageSize size = read_image_header(dir_.write("grey.pgm", kGreyImage)).size;
  EXPECT_EQ(size.width, 3U);
  EXPECT_EQ(size.height, 2U);
}

TEST_F(ImageInfoTest, TheEndingOfTheNameDoesNotMatter) {
  EXPECT_EQ(read_image_header(dir_.write("grey.png", kGreyImage)).size.width, 3U);
  EXPECT_EQ(read_image_header(dir_.write("grey", kGreyImage)).size.width, 3U);
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

}  // namespace
}  // namespace atlasgauge
