#include "io/texture/mtl_reader.hpp"

#include <gtest/gtest.h>

#include <random>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "io/name_room.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

std::vector<Material> read(const std::string& text) {
  const TempDir dir;
  Warnings warnings(nullptr);
  return read_mtl(dir.write("model.mtl", text), warnings);
}

/// The image of a material with this line.
std::string image_of(const std::string& line) {
  const std::vector<Material> materials = read("newmtl m\n" + line + "\n");
  return materials.at(0).image.value_or("(none)");
}

TEST(MtlReaderTest, MaterialsAreListedInOrder) {
  const std::vector<Material> materials = read(
      "# comment\nnewmtl  a b \nKd 1 1 1\nmap_Kd a.png\n\n\tnewmtl c\r\nmap_Kd b.png\r\nnewmtl a "
      "b");
  ASSERT_EQ(materials.size(), 3U);
  EXPECT_EQ(materials[0].name, "a b");
  EXPECT_EQ(materials[0].image, "a.png");
  EXPECT_EQ(materials[1].name, "c");
  EXPECT_EQ(materials[1].image, "b.png");
  EXPECT_EQ(materials[2].name, "a b");
  EXPECT_EQ(materials[2].image, std::nullopt);
}

TEST(MtlReaderTest, AMaterialWithoutANameHasTheEmptyName) {
  EXPECT_EQ(read("newmtl\n").at(0).name, "");
}

TEST(MtlReaderTest, TheLastMapOfAMaterialCounts) {
  EXPECT_EQ(image_of("map_Kd a.png\nmap_Kd b.png"), "b.png");
}

TEST(MtlReaderTest, OtherMapsDoNotCount) {
  EXPECT_EQ(image_of("map_Ka a.png\nmap_Ks b.png\nmap_d c.png\nbump d.png\nmap_kdx e.png"),
            "(none)");
  EXPECT_EQ(read("map_Kd a.png\n").size(), 0U);
}

TEST(MtlReaderTest, NamesKeepTheirSpaces) {
  EXPECT_EQ(image_of("map_Kd my texture  1.png  "), "my texture  1.png");
  EXPECT_EQ(image_of("map_Kd\tmy texture.png\t"), "my texture.png");
}

TEST(MtlReaderTest, QuotesAroundNamesAreTakenOff) {
  EXPECT_EQ(image_of("map_Kd \"my texture.png\""), "my texture.png");
  EXPECT_EQ(image_of("map_Kd -clamp on \"a #1.png\" # comment"), "a #1.png");
  EXPECT_EQ(image_of("map_Kd \"open.png"), "\"open.png");
}

TEST(MtlReaderTest, BackslashesBecomeSlashes) {
  EXPECT_EQ(image_of("map_Kd .\\images\\a.png"), "./images/a.png");
}

TEST(MtlReaderTest, CommentsBeginAtWords) {
  EXPECT_EQ(image_of("map_Kd a#1.png # the first"), "a#1.png");
}

TEST(MtlReaderTest, OptionsAreSkippedWithTheirArguments) {
  for (const char* options :
       {"-blendu on", "-blendv off", "-boost 1.5", "-mm 0.1 1", "-o 0.1", "-o 0.1 0.2",
        "-o 0.1 .2 3e-1", "-s 1 1 1", "-t 0 0 0", "-texres 512", "-clamp on", "-bm 0.5",
        "-imfchan r", "-type cube_top", "-cc off", "-colorspace sRGB",
        "-s 1.0 1.0 1.0 -o 0.0 0.0 0.0", "-blendu on -blendv on -mm 0 1 -t 1 -type sphere"}) {
    EXPECT_EQ(image_of("map_Kd " + std::string(options) + " a b.png"), "a b.png") << options;
    EXPECT_EQ(image_of("map_Kd  " + std::string(options) + "\t 1.png"), "1.png") << options;
  }
}

TEST(MtlReaderTest, ANumberAtTheEndIsTheName) {
  EXPECT_EQ(image_of("map_Kd -o 0.1 0.2 7"), "7");
}

TEST(MtlReaderTest, UnknownOptionsArePartOfTheName) {
  EXPECT_EQ(image_of("map_Kd -odd name.png"), "-odd name.png");
}

TEST(MtlReaderTest, OptionsWithoutANameNameNoImage) {
  for (const char* line : {"map_Kd", "map_Kd  ", "map_Kd -s", "map_Kd -mm 1", "map_Kd -clamp on",
                           "map_Kd # a.png", "map_Kd \"\""}) {
    EXPECT_EQ(image_of(line), "(none)") << line;
  }
}

TEST(MtlReaderTest, AMarkOfUtf8IsSkipped) {
  EXPECT_EQ(read("\xEF\xBB\xBFnewmtl m\n").at(0).name, "m");
}

TEST(MtlReaderTest, OverlongLinesAreIgnoredWithAWarning) {
  const TempDir dir;
  std::vector<std::string> messages;
  Warnings warnings([&](const std::string& text) { messages.push_back(text); });
  const std::string text = "newmtl a\nmap_Kd " + std::string(200000, 'x') + "\nmap_Kd b.png\n";
  const std::vector<Material> materials = read_mtl(dir.write("model.mtl", text), warnings);
  EXPECT_EQ(materials.at(0).image, "b.png");
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_NE(messages[0].find("model.mtl:2: "), std::string::npos);
}

TEST(MtlReaderTest, TooManyNamesAreRefused) {
  const std::string name(60000, 'n');
  const std::size_t too_many = NameRoom::kMaxBytes / name.size() + 1;
  std::string text;
  for (std::size_t i = 0; i < too_many; ++i) text += "newmtl " + name + "\n";
  try {
    read(text);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
  }
}

TEST(MtlReaderTest, AMissingFileIsAnError) {
  Warnings warnings(nullptr);
  EXPECT_THROW(read_mtl("/nowhere/model.mtl", warnings), Error);
}

TEST(MtlReaderTest, AnyBytesAreRead) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    std::string text = "newmtl a\nmap_Kd -s 1 \"b\" c\n";
    for (int i = 0; i < 5; ++i) text[random() % text.size()] = static_cast<char>(random());
    read(text);
  }
}

}  // namespace
}  // namespace atlasgauge
