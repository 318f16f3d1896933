#include "io/image/image_file.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "io/error.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

std::string content_of(const ImageFile& file) {
  std::ifstream stream(file.path(), std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(ImageFileTest, AFileKeepsItsPath) {
  const ImageFile file({.path = "some/image.png"});
  EXPECT_EQ(file.path(), "some/image.png");
  EXPECT_EQ(file.copied_bytes(), 0U);
}

TEST(ImageFileTest, ARangeOfAFileLooksLikeAFile) {
  const TempDir dir;
  const ImageFile file(
      {.path = dir.write("a.glb", "before IMAGE after"), .offset = 7, .byte_size = 5});
  EXPECT_EQ(content_of(file), "IMAGE");
  EXPECT_EQ(file.copied_bytes(), 5U);
}

TEST(ImageFileTest, LargeRangesAreCopiedWhole) {
  const TempDir dir;
  std::string bytes;
  for (int i = 0; i < 300'000; ++i) bytes += static_cast<char>(i * 7 % 251);
  const ImageFile file({.path = dir.write("a.glb", bytes), .offset = 1, .byte_size = 299'990});
  EXPECT_EQ(content_of(file), bytes.substr(1, 299'990));
}

TEST(ImageFileTest, BytesInMemoryLookLikeAFile) {
  const ImageFile file({.path = "model.gltf", .content = std::make_shared<std::string>("IMAGE")});
  EXPECT_EQ(content_of(file), "IMAGE");
}

TEST(ImageFileTest, ARangeBeyondTheFileIsAnError) {
  const TempDir dir;
  const std::string path = dir.write("a.glb", "short");
  EXPECT_THROW(ImageFile({.path = path, .offset = 3, .byte_size = 10}), Error);
  EXPECT_THROW(ImageFile({.path = path, .offset = 30, .byte_size = 10}), Error);
  EXPECT_THROW(ImageFile({.path = path + "none", .byte_size = 10}), Error);
}

}  // namespace
}  // namespace atlasgauge
