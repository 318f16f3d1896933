#include "io/texture/texture_slots.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/error.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using Lines = std::vector<std::string>;

/// A model in a folder of its own, whose images are files that hold "WxH".
class TextureSlotsTest : public ::testing::Test {
 protected:
  static ImageHeader probe(const ImageSource& image) {
    const std::string& path = image.path;
    const auto bytes = static_cast<std::uint32_t>(std::filesystem::file_size(path));
    if (bytes == 0) throw Error(ErrorKind::kInput, path, 0, "no image");
    return {bytes, 2 * bytes};
  }

  TextureSlots resolve(const Lines& mtllib_lines, const Lines& materials,
                       std::optional<ImageSize> size = std::nullopt) {
    Warnings warnings([this](const std::string& text) { messages_.push_back(text); });
    const InputMaterials input = obj("models/model.obj", mtllib_lines, materials);
    return resolve_textures({&input, 1}, size, probe, warnings);
  }

  InputMaterials obj(const std::string& name, const Lines& mtllib_lines, const Lines& materials) {
    return {(dir_.path() / name).string(), ObjMaterials{mtllib_lines, materials}};
  }

  TempDir dir_;
  Lines messages_;
};

TEST_F(TextureSlotsTest, SlotsStandInOrderOfTheLibraries) {
  dir_.write("models/a.mtl", "newmtl one\nmap_Kd 1.png\nnewmtl two\nmap_Kd 2.png\n");
  dir_.write("models/b.mtl",
             "newmtl three\nmap_Kd 3.png\nnewmtl four\nmap_Kd 1.png\nnewmtl five\n");
  for (const char* name : {"1.png", "2.png", "3.png"})
    dir_.write("models/" + std::string(name), "xx");
  const TextureSlots textures = resolve({"a.mtl b.mtl"}, {"four", "three", "five", "unknown"});
  ASSERT_EQ(textures.slots.size(), 3U);
  EXPECT_EQ(textures.slots[0].name, "1.png");
  EXPECT_EQ(textures.slots[1].name, "2.png");
  EXPECT_EQ(textures.slots[2].name, "3.png");
  EXPECT_EQ(textures.slots[2].size->height, 4U);
  EXPECT_TRUE(textures.slots[0].readable);
  EXPECT_EQ(textures.of_material,
            (std::vector{SlotId{0}, SlotId{2}, kNone<SlotId>, kNone<SlotId>}));
  EXPECT_EQ(textures.without_material, kNone<SlotId>);
  EXPECT_TRUE(textures.has_images);
  EXPECT_FALSE(textures.unit_slot);
  EXPECT_TRUE(messages_.empty());
}

TEST_F(TextureSlotsTest, OneFileIsOneSlotHoweverItIsSpelled) {
  dir_.write("models/tex/1.png", "x");
  std::filesystem::create_symlink("1.png", dir_.path() / "models/tex/link.png");
  dir_.write("models/a.mtl",
             "newmtl a\nmap_Kd tex\\1.png\nnewmtl b\nmap_Kd ./tex/../tex/1.png\nnewmtl c\n"
             "map_Kd tex/link.png\nnewmtl d\nmap_Kd " +
                 (dir_.path() / "models/tex/1.png").string() + "\n");
  const TextureSlots textures = resolve({"a.mtl"}, {"a", "b", "c", "d"});
  ASSERT_EQ(textures.slots.size(), 1U);
  EXPECT_EQ(textures.slots[0].name, "tex/1.png");
  EXPECT_EQ(textures.of_material, std::vector<SlotId>(4, SlotId{0}));
}

TEST_F(TextureSlotsTest, ImagesAreLookedForBesideTheLibraryThenBesideTheModel) {
  dir_.write("models/lib/a.mtl", "newmtl a\nmap_Kd 1.png\nnewmtl b\nmap_Kd 2.png\n");
  dir_.write("models/lib/1.png", "x");
  dir_.write("models/1.png", "xx");
  dir_.write("models/2.png", "xxx");
  const TextureSlots textures = resolve({"lib\\a.mtl"}, {});
  ASSERT_EQ(textures.slots.size(), 2U);
  EXPECT_EQ(textures.slots[0].size->width, 1U);
  EXPECT_EQ(textures.slots[1].size->width, 3U);
}

TEST_F(TextureSlotsTest, LibrariesMayLieInAnotherFolder) {
  dir_.write("elsewhere/a.mtl", "newmtl a\nmap_Kd 1.png\n");
  dir_.write("elsewhere/1.png", "x");
  dir_.write("models/model.obj", "");
  EXPECT_TRUE(resolve({"../elsewhere/a.mtl"}, {"a"}).slots[0].readable);
  EXPECT_TRUE(resolve({(dir_.path() / "elsewhere/a.mtl").string()}, {"a"}).slots[0].readable);
}

TEST_F(TextureSlotsTest, TheFirstMaterialOfANameWins) {
  dir_.write("models/a.mtl", "newmtl m\nmap_Kd 1.png\nnewmtl m\nmap_Kd 2.png\n");
  dir_.write("models/b.mtl", "newmtl m\nmap_Kd 3.png\n");
  dir_.write("models/1.png", "x");
  const TextureSlots textures = resolve({"a.mtl", "b.mtl"}, {"m"});
  ASSERT_EQ(textures.slots.size(), 1U);
  EXPECT_EQ(textures.slots[0].name, "1.png");
}

TEST_F(TextureSlotsTest, WithoutALibraryLineTheModelsOwnNameIsTried) {
  dir_.write("models/model.mtl", "newmtl m\nmap_Kd 1.png\n");
  dir_.write("models/1.png", "x");
  EXPECT_EQ(resolve({}, {"m"}).slots.at(0).name, "1.png");
  EXPECT_EQ(resolve({"other.mtl"}, {"m"}).slots.at(0).name, "N/A");
}

TEST_F(TextureSlotsTest, CompressedModelsHaveTheSameOwnLibrary) {
  dir_.write("models/model.mtl", "newmtl m\nmap_Kd 1.png\n");
  dir_.write("models/1.png", "x");
  Warnings warnings(nullptr);
  for (const char* name : {"models/model.obj.gz", "models/model.obj.zst"}) {
    const InputMaterials input = obj(name, {}, {});
    const TextureSlots textures = resolve_textures({&input, 1}, std::nullopt, probe, warnings);
    EXPECT_EQ(textures.slots.at(0).name, "1.png");
  }
}

TEST_F(TextureSlotsTest, MissingLibrariesAreWarnings) {
  dir_.write("models/b.mtl", "newmtl m\nmap_Kd 1.png\n");
  dir_.write("models/1.png", "x");
  EXPECT_EQ(resolve({"a.mtl b.mtl"}, {"m"}).slots.size(), 1U);
  ASSERT_EQ(messages_.size(), 1U);
  EXPECT_NE(messages_[0].find("\"a.mtl\" not found"), std::string::npos);
}

TEST_F(TextureSlotsTest, AModelWithoutImagesHasOneSlotForAllFaces) {
  dir_.write("models/a.mtl", "newmtl m\nKd 1 1 1\n");
  const TextureSlots textures = resolve({"a.mtl"}, {"m", "n"});
  ASSERT_EQ(textures.slots.size(), 1U);
  EXPECT_EQ(textures.slots[0].name, "N/A");
  EXPECT_EQ(textures.slots[0].source.path, "");
  EXPECT_EQ(textures.slots[0].size->width, 1U);
  EXPECT_FALSE(textures.slots[0].readable);
  EXPECT_EQ(textures.of_material, std::vector<SlotId>(2, SlotId{0}));
  EXPECT_EQ(textures.without_material, SlotId{0});
  EXPECT_FALSE(textures.has_images);
  EXPECT_TRUE(textures.unit_slot);
  EXPECT_EQ(messages_.size(), 1U);
}

TEST_F(TextureSlotsTest, TheOptionGivesTheSizeOfTheVirtualSlot) {
  const TextureSlots textures = resolve({}, {}, ImageSize{640, 480});
  EXPECT_EQ(textures.slots.at(0).name, "N/A");
  EXPECT_EQ(textures.slots.at(0).size->height, 480U);
  EXPECT_FALSE(textures.unit_slot);
  EXPECT_TRUE(messages_.empty());
}

TEST_F(TextureSlotsTest, MissingAndBrokenImagesKeepTheirSlotWithoutASize) {
  dir_.write("models/a.mtl", "newmtl a\nmap_Kd none.png\nnewmtl b\nmap_Kd empty.png\n");
  dir_.write("models/empty.png", "");
  const TextureSlots textures = resolve({"a.mtl"}, {"a", "b"});
  ASSERT_EQ(textures.slots.size(), 2U);
  EXPECT_FALSE(textures.slots[0].size.has_value());
  EXPECT_FALSE(textures.slots[1].size.has_value());
  EXPECT_FALSE(textures.slots[1].readable);
  EXPECT_TRUE(textures.has_images);
  EXPECT_EQ(messages_.size(), 2U);
}

TEST_F(TextureSlotsTest, TheOptionGivesTheSizeOfUnreadableImagesOnly) {
  dir_.write("models/a.mtl", "newmtl a\nmap_Kd none.png\nnewmtl b\nmap_Kd 1.png\n");
  dir_.write("models/1.png", "x");
  const TextureSlots textures = resolve({"a.mtl"}, {}, ImageSize{640, 480});
  EXPECT_EQ(textures.slots.at(0).size->width, 640U);
  EXPECT_FALSE(textures.slots.at(0).readable);
  EXPECT_EQ(textures.slots.at(1).size->width, 1U);
}

TEST_F(TextureSlotsTest, AFolderIsNeitherALibraryNorAnImage) {
  dir_.write("models/a.mtl/x", "");
  dir_.write("models/b.mtl", "newmtl m\nmap_Kd tex\n");
  dir_.write("models/tex/x", "");
  const TextureSlots textures = resolve({"a.mtl", "b.mtl"}, {"m"});
  EXPECT_FALSE(textures.slots.at(0).readable);
  EXPECT_EQ(messages_.size(), 2U);
}

TEST_F(TextureSlotsTest, FaultsOfTheProgramAreNotWarnings) {
  dir_.write("models/a.mtl", "newmtl a\nmap_Kd 1.png\n");
  dir_.write("models/1.png", "x");
  Warnings warnings(nullptr);
  const ImageProbe broken = [](const ImageSource&) -> ImageHeader {
    throw Error(ErrorKind::kInternal, "module missing");
  };
  const InputMaterials input = obj("models/model.obj", {"a.mtl"}, {});
  EXPECT_THROW(resolve_textures({&input, 1}, std::nullopt, broken, warnings), Error);
}

}  // namespace
}  // namespace atlasgauge
