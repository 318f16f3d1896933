#include "io/gltf/gltf_images.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/gltf/gltf_reader.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/input_error.hpp"
#include "tests/support/mesh_values.hpp"
#include "tests/support/read_parts.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using Json = nlohmann::json;
using TexCoords = std::vector<std::vector<float>>;

/// A triangle with TEXCOORD_0 all (0.25, 0.5) and TEXCOORD_1 all (0.5, 0.125), of material 0.
GltfBuilder textured_triangle() {
  GltfBuilder gltf;
  const std::size_t positions = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  const std::size_t first = gltf.texcoords({0.25F, 0.5F});
  const std::size_t second = gltf.texcoords({0.5F, 0.125F});
  gltf.show(
      {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", first}, {"TEXCOORD_1", second}}},
       {"material", 0}});
  gltf.document["materials"] =
      Json::parse(R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])");
  gltf.document["textures"] = {{{"source", 0}}};
  gltf.document["images"] = {{{"uri", "colour%20map.png"}}};
  return gltf;
}

Json& colour_of(GltfBuilder& gltf) {
  return gltf.document["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"];
}

class GltfImagesTest : public ::testing::Test {
 protected:
  PartsContent read(GltfBuilder& gltf) const {
    const std::string path = dir_.write("model.glb", gltf.glb());
    return read_parts([&](Warnings& warnings) {
      return GltfReader(path, {{1 << 20, 64}, 1024}, warnings);
    });
  }

  /// The only image.
  NamedImage image_of(GltfBuilder& gltf) const {
    const PartsContent content = read(gltf);
    EXPECT_EQ(content.materials.images.size(), 1U);
    return content.materials.images.at(0);
  }

  /// Texture coordinates with a transform of the texture.
  std::vector<float> moved(const Json& transform) const {
    GltfBuilder gltf = textured_triangle();
    colour_of(gltf)["extensions"]["KHR_texture_transform"] = transform;
    return texcoords_of(read(gltf).mesh()).at(0);
  }

  TempDir dir_;
};

TEST_F(GltfImagesTest, TheBaseColourNamesTheImageDecodedAndBesideTheModel) {
  GltfBuilder gltf = textured_triangle();
  const PartsContent content = read(gltf);
  EXPECT_EQ(content.mesh().faces[0].material, MaterialId{0});
  ASSERT_EQ(content.materials.image_of_material.size(), 1U);
  EXPECT_EQ(content.materials.image_of_material[0], 0U);
  EXPECT_EQ(content.materials.images.at(0).name, "colour map.png");
  EXPECT_EQ(content.materials.images[0].source.path, (dir_.path() / "colour map.png").string());
  EXPECT_TRUE(content.materials.images[0].source.is_whole_file());
  EXPECT_TRUE(content.messages.empty()) << "whether it exists is the driver's business";
}

TEST_F(GltfImagesTest, AnImageOfTwoMaterialsIsListedOnceAndUnusedMaterialsCount) {
  GltfBuilder gltf = textured_triangle();
  gltf.add("images", {{"uri", "./colour%20map.png"}});
  gltf.add("images", {{"uri", "other.png"}});
  gltf.add("textures", {{"source", 1}});
  gltf.add("textures", {{"source", 2}});
  for (const int texture : {1, 2}) {
    gltf.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", texture}}}}}});
  }
  gltf.add("materials", Json::object());
  const PartMaterials materials = read(gltf).materials;
  EXPECT_EQ(materials.images.size(), 2U);
  EXPECT_EQ(materials.image_of_material,
            (std::vector<std::optional<std::uint32_t>>{0, 0, 1, std::nullopt}));
}

TEST_F(GltfImagesTest, AnImageInABufferIsAStretchOfTheFile) {
  GltfBuilder gltf = textured_triangle();
  const std::size_t view = gltf.view("PNG bytes");
  gltf.document["images"][0] = {{"bufferView", view}, {"name", "albedo"}};
  const NamedImage image = image_of(gltf);
  EXPECT_EQ(image.name, "albedo");
  const std::string file = gltf.glb();
  EXPECT_EQ(file.substr(image.source.offset, image.source.byte_size), "PNG bytes");
}

TEST_F(GltfImagesTest, AnImageInTheDocumentIsItsBytes) {
  GltfBuilder gltf = textured_triangle();
  gltf.document["images"][0]["uri"] = "data:image/png;base64," + base64("PNG bytes");
  const NamedImage image = image_of(gltf);
  EXPECT_EQ(image.name, "model.glb#image0");
  ASSERT_NE(image.source.content, nullptr);
  EXPECT_EQ(*image.source.content, "PNG bytes");
}

TEST_F(GltfImagesTest, ANameThatIsNotUniqueTellsNothingApart) {
  GltfBuilder gltf = textured_triangle();
  const std::size_t one = gltf.view("one");
  const std::size_t two = gltf.view("two");
  gltf.document["images"] = {{{"bufferView", one}, {"name", "a"}},
                             {{"bufferView", two}, {"name", "a"}}};
  gltf.add("textures", {{"source", 1}});
  gltf.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 1}}}}}});
  const PartMaterials materials = read(gltf).materials;
  EXPECT_EQ(materials.images.at(0).name, "model.glb#image0");
  EXPECT_EQ(materials.images.at(1).name, "model.glb#image1");
}

TEST_F(GltfImagesTest, TheTextureSaysWhichTextureCoordinatesCount) {
  GltfBuilder gltf = textured_triangle();
  EXPECT_EQ(texcoords_of(read(gltf).mesh()), (TexCoords{{0.25F, 0.5F}}));
  colour_of(gltf)["texCoord"] = 1;
  EXPECT_EQ(texcoords_of(read(gltf).mesh()), (TexCoords{{0.5F, 0.875F}}));
  colour_of(gltf)["extensions"]["KHR_texture_transform"]["texCoord"] = 0;
  EXPECT_EQ(texcoords_of(read(gltf).mesh()), (TexCoords{{0.25F, 0.5F}}));
  colour_of(gltf)["extensions"]["KHR_texture_transform"]["texCoord"] = 2;
  EXPECT_TRUE(read(gltf).mesh().texcoords.empty()) << "there is no TEXCOORD_2";
}

// (0.25, 0.5) with v down. The quarter turn is counter-clockwise as the image shows, so that
// (u, v) becomes (v, -u): the example of the extension's text, offset (0, 1), rotation pi/2, scale
// 1/2, then shows the lower left quadrant.
TEST_F(GltfImagesTest, TheTextureTransformScalesThenTurnsThenMoves) {
  EXPECT_EQ(moved({{"offset", {0.5, 0.25}}}), (std::vector<float>{0.75F, 1 - 0.75F}));
  EXPECT_EQ(moved({{"scale", {2, 0.5}}}), (std::vector<float>{0.5F, 1 - 0.25F}));
  constexpr double kQuarter = 1.5707963267948966;
  EXPECT_EQ(moved({{"rotation", kQuarter}}), (std::vector<float>{0.5F, 1 + 0.25F}));
  EXPECT_EQ(moved({{"offset", {0, 1}}, {"rotation", kQuarter}, {"scale", {0.5, 0.5}}}),
            (std::vector<float>{0.25F, 1 - 0.875F}));
}

TEST_F(GltfImagesTest, SpecularGlossinessAndLightOnBlackGiveTheColourToo) {
  GltfBuilder gltf = textured_triangle();
  gltf.document["materials"][0] = Json::parse(
      R"({"extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseTexture":{"index":0}}}})");
  EXPECT_EQ(image_of(gltf).name, "colour map.png");
  gltf.document["materials"][0] = Json::parse(R"({"emissiveTexture":{"index":0},
      "pbrMetallicRoughness":{"baseColorFactor":[0,0,0,1]}})");
  EXPECT_EQ(image_of(gltf).name, "colour map.png");
  gltf.document["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 0, 0, 1};
  EXPECT_TRUE(read(gltf).materials.images.empty()) << "a lamp is no texture";
}

TEST_F(GltfImagesTest, WebpGoesBeforeItsFallbackAndBasisBehind) {
  GltfBuilder gltf = textured_triangle();
  gltf.add("images", {{"uri", "other"}});
  gltf.document["textures"][0]["extensions"]["EXT_texture_webp"]["source"] = 1;
  EXPECT_EQ(image_of(gltf).name, "other");
  gltf.document["textures"][0]["extensions"] =
      Json::parse(R"({"KHR_texture_basisu":{"source":1}})");
  const PartsContent content = read(gltf);
  EXPECT_EQ(content.materials.images.at(0).name, "colour map.png");
  EXPECT_TRUE(content.messages.empty());
}

TEST_F(GltfImagesTest, BasisWithoutFallbackIsRefusedByNameAndKeepsItsSlot) {
  GltfBuilder gltf = textured_triangle();
  gltf.document["extensionsRequired"] = {"KHR_texture_basisu"};
  gltf.document["textures"][0] =
      Json::parse(R"({"extensions":{"KHR_texture_basisu":{"source":0}}})");
  const PartsContent content = read(gltf);
  EXPECT_EQ(content.parts.size(), 1U) << "geometry is measured";
  EXPECT_EQ(content.materials.images.size(), 1U);
  EXPECT_EQ(content.materials.image_of_material.at(0), 0U);
  EXPECT_EQ(content.warnings.at("image unreadable"), 1U);
  EXPECT_TRUE(says(content.messages.at(0), "image \"colour map.png\" is KTX2/Basis"));
}

TEST_F(GltfImagesTest, AnImageThatIsNowhereKeepsItsSlotToo) {
  GltfBuilder gltf = textured_triangle();
  for (const Json& image : {Json{{"uri", "https://example.org/a.png"}}, Json{{"bufferView", 99}},
                            Json{{"name", "nothing"}}}) {
    gltf.document["images"][0] = image;
    const PartsContent content = read(gltf);
    ASSERT_EQ(content.materials.images.size(), 1U) << image;
    ASSERT_NE(content.materials.images[0].source.content, nullptr) << image;
    EXPECT_TRUE(content.materials.images[0].source.content->empty());
    EXPECT_EQ(content.warnings.at("image unreadable"), 1U) << image;
  }
}

TEST_F(GltfImagesTest, IndicesOfWhatIsNotThereAreAnError) {
  GltfBuilder gltf = textured_triangle();
  gltf.document["textures"][0]["source"] = 5;
  EXPECT_TRUE(says(input_error_of([&] { read(gltf); }), "a texture names image 5"));
  colour_of(gltf)["index"] = 4;
  EXPECT_TRUE(says(input_error_of([&] { read(gltf); }), "a material names texture 4"));
  gltf.document["meshes"][0]["primitives"][0]["material"] = 3;
  EXPECT_TRUE(says(input_error_of([&] { read(gltf); }), "a primitive names material 3"));
}

}  // namespace
}  // namespace atlasgauge
