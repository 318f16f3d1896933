#include "io/file/safe_name.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <set>
#include <string>

namespace atlasgauge {
namespace {

const std::string kSafe = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-";

TEST(SafeNameTest, IsTheNumberAndTheNameWithoutFolderAndSuffix) {
  EXPECT_EQ(safe_file_name(3, "wood.png", ".exr"), "0003_wood.exr");
  EXPECT_EQ(safe_file_name(0, "textures/wood.old.JPG", ".png"), "0000_wood.old.png");
  EXPECT_EQ(safe_file_name(123456, "wood", ".exr"), "123456_wood.exr");
}

TEST(SafeNameTest, NothingOfAPathIsLeft) {
  EXPECT_EQ(safe_file_name(1, "../../etc/x", ".exr"), "0001_x.exr");
  EXPECT_EQ(safe_file_name(1, "C:\\a\\b.png", ".exr"), "0001_b.exr");
  EXPECT_EQ(safe_file_name(1, "C:b.png", ".exr"), "0001_C_b.exr");
  EXPECT_EQ(safe_file_name(1, "a/", ".exr"), "0001.exr");
  EXPECT_EQ(safe_file_name(1, "..", ".exr"), "0001_..exr");
  EXPECT_EQ(safe_file_name(1, "/", ".exr"), "0001.exr");
}

TEST(SafeNameTest, OtherCharactersBecomeUnderscores) {
  EXPECT_EQ(safe_file_name(1, "my  wood (1).png", ".exr"), "0001_my_wood_1_.exr");
  EXPECT_EQ(safe_file_name(1, "K\xC3\xB6rper\xFF.png", ".exr"), "0001_K_rper_.exr");
  EXPECT_EQ(safe_file_name(1, std::string("a\0b\n.png", 8), ".exr"), "0001_a_b_.exr");
  EXPECT_EQ(safe_file_name(1, "", ".exr"), "0001.exr");
  EXPECT_EQ(safe_file_name(1, ".hidden", ".exr"), "0001.exr");
}

TEST(SafeNameTest, LengthIsBounded) {
  std::string name(5000, 'x');
  EXPECT_LE(safe_file_name(SIZE_MAX, name, ".exr").size(), 84U);
  name += ".png";
  EXPECT_EQ(safe_file_name(1, name, ".exr").size(), 5 + 59 + 4U);
}

TEST(SafeNameTest, SameNamesDifferByTheirNumbers) {
  std::set<std::string> names;
  for (std::size_t number = 0; number < 20'000; ++number) {
    names.insert(safe_file_name(number, number % 2 == 0 ? "1" : "", ".exr"));
  }
  EXPECT_EQ(names.size(), 20'000U);
}

TEST(SafeNameTest, AnyBytesGiveASafeName) {
  std::mt19937 random(1);
  for (std::size_t i = 0; i < 5000; ++i) {
    std::string bytes(random() % 300, '\0');
    for (char& byte : bytes) byte = static_cast<char>(random());
    const std::string name = safe_file_name(i, bytes, ".exr");
    EXPECT_EQ(name.find_first_not_of(kSafe), std::string::npos) << name;
    EXPECT_NE(name.front(), '.');
    EXPECT_LE(name.size(), 84U);
    EXPECT_TRUE(name.ends_with(".exr"));
  }
}

}  // namespace
}  // namespace atlasgauge
