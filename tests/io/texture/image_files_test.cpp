#include "io/texture/image_files.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

TEST(ImageFiles, TakesTheFirstSuffixOfAFixedOrder) {
  const TempDir dir;
  const std::filesystem::path model = dir.path() / "model.ply";
  EXPECT_FALSE(image_of_stem(model));
  dir.write("model.ktx2", "");
  dir.write("model", "");
  EXPECT_FALSE(image_of_stem(model));
  for (const char* const name : {"model.exr", "model.BMP", "model.tga", "model.webp", "model.tiff",
                                 "model.tif", "model.jpeg", "model.JPG", "model.png"}) {
    dir.write(name, "");
    ASSERT_TRUE(image_of_stem(model));
    EXPECT_EQ(image_of_stem(model)->name, name);
  }
}

TEST(ImageFiles, TakesNoFolderForAnImageAndNoPackingForAStem) {
  const TempDir dir;
  dir.write("model.png/x", "");
  EXPECT_FALSE(image_of_stem(dir.path() / "model.ply.gz"));
  dir.write("model.jpg", "");
  EXPECT_EQ(image_of_stem(dir.path() / "model.ply.gz")->name, "model.jpg");
  EXPECT_EQ(without_compression("a/model.obj.zst"), "a/model.obj");
}

TEST(ImageFiles, FindsAnImageInTheFirstFolderThatHasIt) {
  const TempDir dir;
  const std::string second = dir.write("b/x.png", "");
  const ImagePlace found = find_image({dir.path() / "a", dir.path() / "b"}, "x.png");
  EXPECT_TRUE(found.exists);
  EXPECT_EQ(found.path, std::filesystem::canonical(second));
  const ImagePlace missing = find_image({dir.path() / "a", dir.path() / "b"}, "y.png");
  EXPECT_FALSE(missing.exists);
  EXPECT_EQ(missing.path, (std::filesystem::canonical(dir.path()) / "a/y.png").string());
}

}  // namespace
}  // namespace atlasgauge
