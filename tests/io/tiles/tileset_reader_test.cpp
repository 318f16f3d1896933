#include "io/tiles/tileset_reader.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "tests/support/gltf_builder.hpp"
#include "tests/support/input_error.hpp"
#include "tests/support/mesh_values.hpp"
#include "tests/support/read_parts.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using Json = nlohmann::json;
using Positions = std::vector<std::vector<double>>;

/// A tileset whose tiles are triangles that begin at (number, 0, 0), so that the first positions
/// tell which tiles are shown.
class TilesetReaderTest : public ::testing::Test {
 protected:
  TilesetReaderTest() {
    for (int number = 0; number < 10; ++number) {
      dir_.write(std::to_string(number) + ".glb", tile(static_cast<float>(number)));
    }
  }

  static std::string tile(float x) {
    GltfBuilder gltf;
    gltf.show({{"attributes", {{"POSITION", gltf.positions({x, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
    return gltf.glb();
  }

  static Json content(int number) { return {{"uri", std::to_string(number) + ".glb"}}; }

  static Json leaf(int number) { return {{"content", content(number)}}; }

  /// A tile of three levels, and a leaf beside its child:
  /// 0 (1 (2 3) 4)
  static Json tree(const char* refine) {
    Json root = leaf(0);
    root["refine"] = refine;
    root["children"] = {leaf(1), leaf(4)};
    root["children"][0]["children"] = {leaf(2), leaf(3)};
    return root;
  }

  /// Glb tiles have their y up; numbers are along x, which stays.
  std::string write(const Json& root, const std::string& name = "tileset.json") const {
    return dir_.write(name, Json({{"asset", {{"version", "1.1"}}}, {"root", root}}).dump());
  }

  PartsContent read_file(const std::string& path, std::optional<std::uint32_t> cut = {},
                         bool strict = false) const {
    return read_parts(
        [&](Warnings& warnings) {
          return TilesetReader(path, cut, {{1 << 20, 64}, 1024}, warnings);
        },
        strict);
  }

  PartsContent read(const Json& root, std::optional<std::uint32_t> cut = {}) const {
    return read_file(write(root), cut);
  }

  static std::vector<double> shown(const PartsContent& content) {
    std::vector<double> numbers;
    for (const PartContent& part : content.parts) numbers.push_back(part.mesh.positions.at(0).x);
    return numbers;
  }

  std::vector<double> shown(const Json& root, std::optional<std::uint32_t> cut = {}) const {
    return shown(read(root, cut));
  }

  using Numbers = std::vector<double>;
  TempDir dir_;
};

TEST_F(TilesetReaderTest, LeavesAreShownInTheOrderOfTheTilesetDepthFirst) {
  EXPECT_EQ(shown(tree("REPLACE")), (Numbers{2, 3, 4}));
}

TEST_F(TilesetReaderTest, AtADepthTilesThereAndLeavesAboveAreShown) {
  EXPECT_EQ(shown(tree("REPLACE"), 0), (Numbers{0}));
  EXPECT_EQ(shown(tree("REPLACE"), 1), (Numbers{1, 4}));
  EXPECT_EQ(shown(tree("REPLACE"), 2), (Numbers{2, 3, 4}));
  EXPECT_EQ(shown(tree("REPLACE"), 9), (Numbers{2, 3, 4}));
}

TEST_F(TilesetReaderTest, TilesThatAddStayWhenTheirChildrenAreShown) {
  EXPECT_EQ(shown(tree("ADD")), (Numbers{0, 1, 2, 3, 4})) << "refine is inherited";
  EXPECT_EQ(shown(tree("ADD"), 1), (Numbers{0, 1, 4}));
  EXPECT_EQ(shown(tree("add"), 0), (Numbers{0})) << "small letters are of older tilesets";
  Json mixed = tree("ADD");
  mixed["children"][0]["refine"] = "REPLACE";
  EXPECT_EQ(shown(mixed), (Numbers{0, 2, 3, 4}));
}

TEST_F(TilesetReaderTest, AnEmptyTileStandsForItsChildren) {
  Json root = tree("REPLACE");
  root["children"][0].erase("content");
  EXPECT_EQ(shown(root, 1), (Numbers{2, 3, 4}));
  root.erase("content");
  EXPECT_EQ(shown(root, 0), (Numbers{2, 3, 4}));
}

TEST_F(TilesetReaderTest, ATileMayHaveSeveralContents) {
  Json root = leaf(5);
  root["contents"] = {content(6), {{"url", "7.glb"}}};
  EXPECT_EQ(shown(root), (Numbers{5, 6, 7}));
  root = Json::object();
  root["extensions"]["3DTILES_multiple_contents"]["contents"] = {content(8), content(9)};
  EXPECT_EQ(shown(root), (Numbers{8, 9}));
}

TEST_F(TilesetReaderTest, AnExternalTilesetStandsInThePlaceOfItsTile) {
  const Json whole = tree("REPLACE");
  write(whole["children"][0], "sub/inner.json");
  for (int number = 1; number < 4; ++number) {
    dir_.write("sub/" + std::to_string(number) + ".glb", tile(static_cast<float>(number)));
  }
  Json cut = whole;
  cut["children"][0] = {{"content", {{"uri", "sub/inner.json?key=1"}}}};
  for (std::uint32_t depth = 0; depth < 4; ++depth) {
    EXPECT_EQ(shown(cut, depth), shown(whole, depth)) << depth;
  }
  EXPECT_EQ(shown(cut), shown(whole));
  cut["refine"] = "ADD";
  EXPECT_EQ(shown(cut), (Numbers{0, 1, 2, 3, 4})) << "the external root says nothing itself";
}

TEST_F(TilesetReaderTest, YIsTurnedToZUnlessTheTilesetSaysWhichAxisIsUp) {
  GltfBuilder gltf;
  gltf.show({{"attributes", {{"POSITION", gltf.positions({1, 2, 3})}}}});
  dir_.write("axes.glb", gltf.glb());
  const auto position = [&](const Json& up) {
    Json tileset = {{"asset", {{"version", "1.0"}}},
                    {"root", {{"content", {{"uri", "axes.glb"}}}}}};
    if (!up.is_null()) tileset["asset"]["gltfUpAxis"] = up;
    return positions_of(read_file(dir_.write("t.json", tileset.dump())).mesh()).at(0);
  };
  EXPECT_EQ(position(nullptr), (Numbers{1, -3, 2}));
  EXPECT_EQ(position("Y"), (Numbers{1, -3, 2}));
  EXPECT_EQ(position("z"), (Numbers{1, 2, 3}));
  EXPECT_EQ(position("X"), (Numbers{-3, 2, 1}));
  EXPECT_TRUE(says(input_error_of([&] { position("up"); }), "asset.gltfUpAxis: expected \"X\""));
}

TEST_F(TilesetReaderTest, AnExternalTilesetTakesOverTheAxisThatIsUp) {
  write({{"content", {{"uri", "axes.glb"}}}}, "inner.json");
  GltfBuilder gltf;
  gltf.show({{"attributes", {{"POSITION", gltf.positions({1, 2, 3})}}}});
  dir_.write("axes.glb", gltf.glb());
  const Json outer = {{"asset", {{"version", "1.0"}, {"gltfUpAxis", "Z"}}},
                      {"root", {{"content", {{"uri", "inner.json"}}}}}};
  EXPECT_EQ(positions_of(read_file(dir_.write("outer.json", outer.dump())).mesh()),
            (Positions{{1, 2, 3}}));
}

TEST_F(TilesetReaderTest, TransformsOfAllTilesAboveAndTheCenterGoAroundTheTurnedAxes) {
  GltfBuilder gltf;
  gltf.show({{"attributes", {{"POSITION", gltf.positions({1, 2, 3})}}}});
  dir_.write("a.b3dm", make_b3dm(gltf.glb(), R"({"RTC_CENTER":[100,200,300]})"));
  // The axes turned: (1, -3, 2); the center: (101, 197, 302); twice as large: (202, 394, 604);
  // moved by the root.
  Json root = {{"transform", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1000, 2000, 3000, 1}},
               {"children",
                {{{"transform", {2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1}},
                  {"content", {{"uri", "a.b3dm"}}}}}}};
  EXPECT_EQ(positions_of(read(root).mesh()), (Positions{{1202, 2394, 3604}}));
  write(root["children"][0], "inner.json");
  root["children"][0] = {{"content", {{"uri", "inner.json"}}}};
  EXPECT_EQ(positions_of(read(root).mesh()), (Positions{{1202, 2394, 3604}})) << "the same outside";
}

TEST_F(TilesetReaderTest, TheCenterOfCesiumHasZUpAsTheTilesetHas) {
  GltfBuilder gltf;
  gltf.show({{"attributes", {{"POSITION", gltf.positions({1, 2, 3})}}}});
  gltf.document["extensions"]["CESIUM_RTC"]["center"] = {100, 200, 300};
  dir_.write("a.glb", gltf.glb());
  EXPECT_EQ(positions_of(read({{"content", {{"uri", "a.glb"}}}}).mesh()),
            (Positions{{101, 197, 302}}));
}

TEST_F(TilesetReaderTest, ATileThatCannotBeReadIsAWarningAndTheRestIsMeasured) {
  Json root = tree("REPLACE");
  root["children"][0]["children"][0] = {{"content", {{"uri", "missing.b3dm"}}}};
  root["children"].push_back({{"content", {{"uri", "https://example.org/a.b3dm"}}}});
  root["children"].push_back({{"content", {{"uri", "missing.json"}}}});
  dir_.write("cut.glb", tile(1).substr(0, 60));
  root["children"].push_back({{"content", {{"uri", "cut.glb"}}}});
  dir_.write("packed.glb", "\x1F\x8B\x08");
  root["children"].push_back({{"content", {{"uri", "packed.glb"}}}});
  const PartsContent content = read(root);
  EXPECT_EQ(shown(content), (Numbers{3, 4}));
  EXPECT_EQ(content.warnings.at("tiles unreadable"), 5U);
  EXPECT_TRUE(says(content.messages.at(0), "missing.b3dm: cannot open"));
  EXPECT_TRUE(says(content.messages.at(1), "which is no file"));
  EXPECT_TRUE(says(content.messages.at(4), "compressed by gzip"));
  EXPECT_TRUE(says(input_error_of([&] { read_file(write(root), {}, true); }), "missing.b3dm"))
      << "with warnings as errors";
}

TEST_F(TilesetReaderTest, ATilesetOfUnreadableTilesIsAnError) {
  EXPECT_TRUE(says(input_error_of([&] {
                     read({{"content", {{"uri", "missing.b3dm"}}}});
                   }),
                   "none of the tiles could be read (1 faults), the first: "));
  EXPECT_TRUE(says(input_error_of([&] {
                     read({{"children", {Json::object()}}});
                   }),
                   "found no tile with triangles"));
}

TEST_F(TilesetReaderTest, AFaultThatOnlyLoadingFindsLeavesOutThePart) {
  GltfBuilder gltf = one_triangle();
  gltf.document["accessors"][0]["sparse"] = {
      {"count", 2},
      {"indices",
       {{"bufferView", gltf.view(bytes_of<std::uint8_t>(1, 1))},
        {"componentType", GltfBuilder::kUnsignedByte}}},
      {"values", {{"bufferView", gltf.view(bytes_of<float>(7, 8, 9, 5, 6, 7))}}}};
  gltf.add("nodes", {{"mesh", 0}});
  dir_.write("damaged.glb", gltf.glb());
  Json root = tree("REPLACE");
  root["children"].push_back({{"content", {{"uri", "damaged.glb"}}}});
  const PartsContent content = read(root);
  ASSERT_EQ(content.parts.size(), 5U);
  EXPECT_TRUE(content.mesh(3).positions.empty() && content.mesh(3).faces.empty());
  EXPECT_EQ(content.warnings.at("tiles unreadable"), 1U) << "once a tile";
}

TEST_F(TilesetReaderTest, TilesetsThatNameEachOtherInACircleAreAnError) {
  write({{"content", {{"uri", "b.json"}}}}, "a.json");
  write({{"content", {{"uri", "./sub/../a.json"}}}}, "b.json");
  dir_.write("sub/x", "");
  EXPECT_TRUE(says(input_error_of([&] { read_file((dir_.path() / "a.json").string()); }),
                   "which it lies within itself: a circle"));
}

TEST_F(TilesetReaderTest, TheSameExternalTilesetMayStandInTwoPlaces) {
  write(leaf(7), "inner.json");
  EXPECT_EQ(
      shown({{"children",
              {{{"content", {{"uri", "inner.json"}}}}, {{"content", {{"uri", "inner.json"}}}}}}}),
      (Numbers{7, 7}));
}

TEST_F(TilesetReaderTest, ImplicitTilingIsRefusedByName) {
  Json root = leaf(0);
  root["implicitTiling"] = Json::object();
  EXPECT_TRUE(says(input_error_of([&] { read(root); }), "root: found implicit tiling"));
  root = leaf(0);
  root["extensions"]["3DTILES_implicit_tiling"] = Json::object();
  EXPECT_TRUE(says(input_error_of([&] { read(root); }), "root: found implicit tiling"));
}

TEST_F(TilesetReaderTest, WhatIsNoTilesetIsAnErrorThatSaysWhere) {
  const auto fault = [&](const std::string& text) {
    return input_error_of([&] { read_file(dir_.write("t.json", text)); });
  };
  EXPECT_TRUE(says(fault("{}"), "t.json: the JSON: found no \"asset\" and \"root\""));
  EXPECT_TRUE(says(fault("[]"), "no tileset"));
  EXPECT_TRUE(says(fault(R"({"asset":{"version":"2.0"},"root":{}})"), "found 3D Tiles 2.0"));
  EXPECT_TRUE(says(fault(R"({"asset":{},"root":{"children":[{"refine":"MERGE"}]}})"),
                   "root.children[0].refine: expected \"ADD\" or \"REPLACE\""));
  EXPECT_TRUE(says(fault(R"({"asset":{},"root":{"transform":[1,2]}})"),
                   "root.transform: expected 16 numbers"));
  EXPECT_TRUE(
      says(fault(R"({"asset":{},"root":{"content":{}}})"), "root.content: \"url\" is missing"));
  EXPECT_TRUE(says(fault(R"({"asset":{},"root":{},"extensionsRequired":["ACME_x"]})"), "ACME_x"));
}

TEST_F(TilesetReaderTest, ImagesOfTilesAreNamedAfterThemAndSharedFilesAreListedOnce) {
  const auto textured = [](const Json& image) {
    GltfBuilder gltf = one_triangle();
    gltf.document["meshes"][0]["primitives"][0]["material"] = 0;
    gltf.document["materials"] =
        Json::parse(R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}])");
    gltf.document["textures"] = {{{"source", 0}}};
    gltf.document["images"] = {image};
    return gltf.glb();
  };
  dir_.write("sub/0.glb", textured({{"bufferView", 0}}));
  dir_.write("1.glb", textured({{"bufferView", 0}, {"name", "photo"}}));
  dir_.write("2.glb", textured({{"uri", "shared.jpg"}}));
  dir_.write("sub/3.glb", textured({{"uri", "../shared.jpg"}}));
  dir_.write("sub/4.glb", textured({{"uri", "shared.jpg"}}));
  Json children;
  for (const char* const uri : {"./sub/0.glb", "1.glb", "2.glb", "sub/3.glb", "sub/4.glb"}) {
    children.push_back({{"content", {{"uri", uri}}}});
  }
  const PartsContent content = read({{"children", children}});
  std::vector<std::string> names;
  for (const NamedImage& image : content.materials.images) names.push_back(image.name);
  EXPECT_EQ(names, (std::vector<std::string>{"sub/0.glb#image0", "1.glb#photo", "shared.jpg",
                                             "sub/4.glb#shared.jpg"}));
  EXPECT_EQ(content.materials.image_of_material,
            (std::vector<std::optional<std::uint32_t>>{0, 1, 2, 2, 3}));
  EXPECT_EQ(content.mesh(3).faces[0].material, MaterialId{3});
}

}  // namespace
}  // namespace atlasgauge
