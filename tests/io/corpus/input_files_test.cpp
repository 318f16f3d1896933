#include "io/corpus/input_files.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/compressed.hpp"
#include "tests/support/draco_stream.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Names = std::vector<std::string>;

constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
constexpr const char* kRed = "newmtl red\nmap_Kd red.png\n";

/// A folder with a model, whose files have names relative to it.
class InputFilesTest : public ::testing::Test {
 protected:
  ModelInputs inputs(const std::string& name, const PartOptions& options = {}) const {
    ModelInputs inputs = list_model_inputs((dir_.path() / name).string(), options);
    const fs::path root = fs::canonical(dir_.path());
    for (std::string& path : inputs.files) {
      path = fs::weakly_canonical(path).lexically_relative(root).string();
    }
    return inputs;
  }

  Names files(const std::string& name, const PartOptions& options = {}) const {
    const ModelInputs listed = inputs(name, options);
    EXPECT_EQ(listed.fault, std::nullopt);
    return listed.files;
  }

  Names files_of_obj(const std::string& text) const {
    dir_.write("model.obj", text);
    return files("model.obj");
  }

  void write_tileset(const std::string& name, const Json& root) const {
    dir_.write(name, Json({{"asset", {{"version", "1.1"}}}, {"root", root}}).dump());
  }

  /// A glTF whose bytes are in "buffer.bin".
  static GltfBuilder with_external_buffer() {
    GltfBuilder gltf = one_triangle();
    gltf.document["buffers"] = {{{"byteLength", gltf.binary.size()}, {"uri", "buffer.bin"}}};
    return gltf;
  }

  /// With a material that shows an image.
  static void show_image(GltfBuilder& gltf, const Json& image) {
    gltf.add("images", image);
    gltf.add("textures", {{"source", 0}});
    gltf.add("materials", {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}});
  }

  TempDir dir_;
};

TEST_F(InputFilesTest, AnObjComesBeforeItsLibraryAndItsImages) {
  dir_.write("model.mtl", "newmtl a\nmap_Kd b.png\nnewmtl b\nmap_Kd a.png\n");
  dir_.write("a.png", "");
  dir_.write("b.png", "");
  EXPECT_EQ(files_of_obj("mtllib model.mtl\n" + std::string(kTriangle)),
            (Names{"model.obj", "model.mtl", "b.png", "a.png"}));
}

TEST_F(InputFilesTest, ALibraryIsFoundBehindManyBlocksOfText) {
  std::string text = kTriangle;
  while (text.size() < (std::size_t{3} << 20)) text += "v 0.125 0.25 0.5\nf -1 -2 -3\n";
  dir_.write("late.mtl", kRed);
  EXPECT_EQ(files_of_obj(text + "mtllib late.mtl"), (Names{"model.obj", "late.mtl", "red.png"}));
}

TEST_F(InputFilesTest, ALibraryIsFoundInALineOfSeveralBlocks) {
  const std::string blanks(std::size_t{3} << 20, ' ');
  dir_.write("far.mtl", kRed);
  EXPECT_EQ(files_of_obj(kTriangle + ("mtllib far.mtl" + blanks) + "\n"),
            (Names{"model.obj", "far.mtl", "red.png"}));
}

TEST_F(InputFilesTest, AllLibrariesOfAllLinesAreListed) {
  for (const char* const name : {"a.mtl", "b c.mtl", "d.mtl"}) dir_.write(name, "");
  EXPECT_EQ(files_of_obj("mtllib d.mtl a.mtl\nv 0 0 0\nmtllib \\\n b c.mtl\nmtllib a.mtl\n"),
            (Names{"model.obj", "d.mtl", "a.mtl", "b c.mtl"}));
}

TEST_F(InputFilesTest, AMissingLibraryIsListedWhereItWouldBe) {
  EXPECT_EQ(files_of_obj("mtllib sub\\none.mtl\nv 0 0 0\n"), (Names{"model.obj", "sub/none.mtl"}));
}

TEST_F(InputFilesTest, AMissingLibraryInQuotesIsListedWithoutThem) {
  const Names listed = files_of_obj("mtllib \"none.mtl\"\nv 0 0 0\n");
  EXPECT_EQ(listed, (Names{"model.obj", "\"none.mtl\"", "none.mtl"}));
}

TEST_F(InputFilesTest, OfMissingLibrariesInOneLineAllWordsAreListedToo) {
  EXPECT_EQ(files_of_obj("mtllib a.mtl b.mtl\nv 0 0 0\n"),
            (Names{"model.obj", "a.mtl b.mtl", "a.mtl", "b.mtl"}));
}

TEST_F(InputFilesTest, AnObjThatNamesNoLibraryHasTheOneOfItsName) {
  dir_.write("model.mtl", kRed);
  EXPECT_EQ(files_of_obj(kTriangle), (Names{"model.obj", "model.mtl", "red.png"}));
}

TEST_F(InputFilesTest, TheLibraryOfAnObjsNameIsListedThoughMissing) {
  EXPECT_EQ(files_of_obj(kTriangle), (Names{"model.obj", "model.mtl"}));
}

TEST_F(InputFilesTest, AnImageIsListedWhereItLiesAndWhereOneWouldBeFoundFirst) {
  dir_.write("maps/model.mtl", kRed);
  dir_.write("red.png", "");
  EXPECT_EQ(files_of_obj("mtllib maps/model.mtl\nv 0 0 0\n"),
            (Names{"model.obj", "maps/model.mtl", "red.png", "maps/red.png"}));
}

TEST_F(InputFilesTest, AMissingImageIsListedWhereItWouldBe) {
  dir_.write("maps/model.mtl", kRed);
  EXPECT_EQ(files_of_obj("mtllib maps/model.mtl\nv 0 0 0\n"),
            (Names{"model.obj", "maps/model.mtl", "maps/red.png"}));
}

TEST_F(InputFilesTest, AnImageOfTwoLibrariesIsListedOnce) {
  dir_.write("a.mtl", kRed);
  dir_.write("b.mtl", "newmtl other\nmap_Kd ./red.png\n");
  EXPECT_EQ(files_of_obj("mtllib a.mtl b.mtl\nv 0 0 0\n"),
            (Names{"model.obj", "a.mtl", "b.mtl", "red.png"}));
}

TEST_F(InputFilesTest, AnImageThatMeasuringNeverSeesIsNotListed) {
  dir_.write("a.mtl", std::string(kRed) + "newmtl red\nmap_Kd never.png\n");
  EXPECT_EQ(files_of_obj("mtllib a.mtl\nv 0 0 0\n"), (Names{"model.obj", "a.mtl", "red.png"}));
}

TEST_F(InputFilesTest, CompressedObjAreReadThrough) {
  dir_.write("a.mtl", kRed);
  const std::string text = std::string(kTriangle) + "mtllib a.mtl\n";
  dir_.write("model.obj.gz", gzip(text));
  dir_.write("model.obj.zst", zstd(text));
  EXPECT_EQ(files("model.obj.gz"), (Names{"model.obj.gz", "a.mtl", "red.png"}));
  EXPECT_EQ(files("model.obj.zst"), (Names{"model.obj.zst", "a.mtl", "red.png"}));
}

TEST_F(InputFilesTest, LibrariesBeforeAFaultAreListedWithIt) {
  dir_.write("a.mtl", kRed);
  dir_.write("model.obj", "mtllib a.mtl\nv 0 zero 0\n");
  const ModelInputs listed = inputs("model.obj");
  EXPECT_EQ(listed.files, (Names{"model.obj", "a.mtl", "red.png"}));
  EXPECT_NE(listed.fault.value_or("").find("model.obj:2: "), std::string::npos);
}

TEST_F(InputFilesTest, AFaultFarFromLibrariesIsLeftToMeasuring) {
  EXPECT_EQ(files_of_obj("v 0 zero 0\n"), (Names{"model.obj", "model.mtl"}));
}

TEST_F(InputFilesTest, AMissingModelIsListedWithAFault) {
  const ModelInputs listed = inputs("none.obj");
  EXPECT_EQ(listed.files, Names{"none.obj"});
  EXPECT_NE(listed.fault.value_or("").find("cannot open"), std::string::npos);
}

TEST_F(InputFilesTest, APipeIsNotWaitedFor) {
  ASSERT_EQ(::mkfifo((dir_.path() / "pipe.obj").c_str(), 0600), 0);
  const ModelInputs listed = inputs("pipe.obj");
  EXPECT_EQ(listed.files, Names{"pipe.obj"});
  EXPECT_TRUE(listed.fault);
}

TEST_F(InputFilesTest, APlyHasTheImagesOfItsComments) {
  dir_.write("a.png", "");
  dir_.write("model.ply",
             "ply\nformat ascii 1.0\ncomment TextureFile a.png\ncomment TextureFile none.png\n"
             "element vertex 1\nproperty float x\nproperty float y\nproperty float z\n"
             "end_header\n");
  EXPECT_EQ(files("model.ply"), (Names{"model.ply", "a.png", "none.png"}));
}

/// Names no image.
constexpr const char* kPly =
    "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
    "property float z\nend_header\n";

TEST_F(InputFilesTest, TheImageOfAPlysNameIsListedAfterThoseThatWouldBeFoundFirst) {
  dir_.write("model.JPG", "");
  dir_.write("model.ply", kPly);
  EXPECT_EQ(files("model.ply"),
            (Names{"model.ply", "model.png", "model.PNG", "model.jpg", "model.JPG"}));
}

TEST_F(InputFilesTest, WithoutAnImageOfAPlysNameAllThatAreSoughtAreListed) {
  dir_.write("model.ply.gz", gzip(kPly));
  const Names found = files("model.ply.gz");
  ASSERT_EQ(found.size(), 1 + 2 * 9U);
  EXPECT_EQ(found[1], "model.png");
  EXPECT_EQ(found.back(), "model.EXR");
}

TEST_F(InputFilesTest, ADracoStreamWithMaterialsHasALibrary) {
  dir_.write("model.drc", encode_draco(*DracoGrid{.cells = 1, .has_materials = true}.mesh(), {}));
  dir_.write("model.mtl", "newmtl wall\nmap_Kd wall.png\n");
  EXPECT_EQ(files("model.drc"), (Names{"model.drc", "model.mtl", "wall.png"}));
}

TEST_F(InputFilesTest, TheLibraryOfADracoStreamIsListedThoughMissing) {
  dir_.write("model.drc", encode_draco(*DracoGrid{.cells = 1, .has_materials = true}.mesh(), {}));
  dir_.write("model.png", "");
  EXPECT_EQ(files("model.drc"), (Names{"model.drc", "model.mtl", "model.png"}));
}

TEST_F(InputFilesTest, ADracoStreamWithoutMaterialsHasNoLibrary) {
  dir_.write("model.drc", encode_draco(*DracoGrid{.cells = 1}.mesh(), {}));
  dir_.write("model.mtl", kRed);
  dir_.write("model.png", "");
  EXPECT_EQ(files("model.drc"), (Names{"model.drc", "model.png"}));
}

TEST_F(InputFilesTest, AGltfHasItsBuffersAndImages) {
  GltfBuilder gltf = with_external_buffer();
  show_image(gltf, {{"uri", "maps/a%20b.png"}});
  dir_.write("buffer.bin", gltf.binary);
  dir_.write("model.gltf", gltf.document.dump());
  EXPECT_EQ(files("model.gltf"), (Names{"model.gltf", "buffer.bin", "maps/a b.png"}));
}

TEST_F(InputFilesTest, AMissingBufferIsListedWithTheFault) {
  dir_.write("model.gltf", with_external_buffer().document.dump());
  const ModelInputs listed = inputs("model.gltf");
  EXPECT_EQ(listed.files, (Names{"model.gltf", "buffer.bin"}));
  EXPECT_NE(listed.fault.value_or("").find("buffer.bin"), std::string::npos);
}

TEST_F(InputFilesTest, ABufferThatNothingReadsIsNotListed) {
  GltfBuilder gltf = with_external_buffer();
  gltf.add("buffers", {{"byteLength", 1}, {"uri", "unused.bin"}});
  dir_.write("buffer.bin", gltf.binary);
  dir_.write("model.gltf", gltf.document.dump());
  EXPECT_EQ(files("model.gltf"), (Names{"model.gltf", "buffer.bin"}));
}

TEST_F(InputFilesTest, ABufferOfAnImageAloneIsListed) {
  GltfBuilder gltf = one_triangle();
  dir_.write("image.bin", "bytes");
  gltf.document["buffers"] = {{{"byteLength", gltf.binary.size()}},
                              {{"byteLength", 5}, {"uri", "image.bin"}}};
  const std::size_t view = gltf.add("bufferViews", {{"buffer", 1}, {"byteLength", 5}});
  show_image(gltf, {{"bufferView", view}, {"mimeType", "image/png"}});
  dir_.write("model.glb", gltf.glb());
  EXPECT_EQ(files("model.glb"), (Names{"model.glb", "image.bin"}));
}

TEST_F(InputFilesTest, AGlbWithItsImagesIsOneFile) {
  GltfBuilder gltf = one_triangle();
  show_image(gltf, {{"bufferView", gltf.view("bytes")}, {"mimeType", "image/png"}});
  dir_.write("model.glb", gltf.glb());
  EXPECT_EQ(files("model.glb"), Names{"model.glb"});
}

TEST_F(InputFilesTest, AnImageInADataUriIsNoFile) {
  GltfBuilder gltf = one_triangle();
  show_image(gltf, {{"uri", "data:image/png;base64,AAAA"}});
  dir_.write("model.glb", gltf.glb());
  EXPECT_EQ(files("model.glb"), Names{"model.glb"});
}

TEST_F(InputFilesTest, ATilesetHasItsTilesetsTilesAndTheirFiles) {
  write_tileset(
      "tileset.json",
      {{"children",
        {{{"content", {{"uri", "a.glb"}}}}, {{"content", {{"uri", "sub/inner.json"}}}}}}});
  write_tileset("sub/inner.json", {{"content", {{"uri", "b.gltf"}}}});
  GltfBuilder image = one_triangle();
  show_image(image, {{"uri", "a.png"}});
  dir_.write("a.glb", image.glb());
  const GltfBuilder external = with_external_buffer();
  dir_.write("sub/buffer.bin", external.binary);
  dir_.write("sub/b.gltf", external.document.dump());
  EXPECT_EQ(files("tileset.json"), (Names{"tileset.json", "a.glb", "sub/inner.json", "sub/b.gltf",
                                          "sub/buffer.bin", "a.png"}));
}

TEST_F(InputFilesTest, MissingTilesAndTilesetsAreListed) {
  write_tileset("tileset.json", {{"children",
                                  {{{"content", {{"uri", "none.glb"}}}},
                                   {{"content", {{"uri", "none.json"}}}},
                                   {{"content", {{"uri", "a.glb"}}}}}}});
  dir_.write("a.glb", one_triangle().glb());
  EXPECT_EQ(files("tileset.json"), (Names{"tileset.json", "none.glb", "none.json", "a.glb"}));
}

TEST_F(InputFilesTest, ATilesetHasTheTilesOfItsLevelOfDetail) {
  write_tileset("tileset.json", {{"refine", "REPLACE"},
                                 {"content", {{"uri", "coarse.glb"}}},
                                 {"children", {{{"content", {{"uri", "fine.glb"}}}}}}});
  for (const char* const name : {"coarse.glb", "fine.glb"}) {
    dir_.write(name, one_triangle().glb());
  }
  EXPECT_EQ(files("tileset.json"), (Names{"tileset.json", "fine.glb"}));
  EXPECT_EQ(files("tileset.json", {.lod = 0}), (Names{"tileset.json", "coarse.glb"}));
}

TEST_F(InputFilesTest, ATilesetOfMissingTilesAloneListsThemWithAFault) {
  write_tileset("tileset.json", {{"content", {{"uri", "none.glb"}}}});
  const ModelInputs listed = inputs("tileset.json");
  EXPECT_EQ(listed.files, (Names{"tileset.json", "none.glb"}));
  EXPECT_TRUE(listed.fault);
}

TEST_F(InputFilesTest, AMalformedModelIsListedWithItsFault) {
  dir_.write("tileset.json", "{\"asset\": ");
  const ModelInputs listed = inputs("tileset.json");
  EXPECT_EQ(listed.files, Names{"tileset.json"});
  EXPECT_NE(listed.fault.value_or("").find("tileset.json"), std::string::npos);
}

TEST_F(InputFilesTest, AModelBeyondTheLimitsIsListedWithItsFault) {
  write_tileset("tileset.json", {{"content", {{"uri", "a.glb"}}}});
  const ModelInputs listed = inputs("tileset.json", {.lod = {}, .json_bytes = 16});
  EXPECT_EQ(listed.files, Names{"tileset.json"});
  EXPECT_TRUE(listed.fault);
}

}  // namespace
}  // namespace atlasgauge
