#include "io/gltf/gltf_reader.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/gltf_builder.hpp"
#include "tests/support/input_error.hpp"
#include "tests/support/mesh_values.hpp"
#include "tests/support/read_parts.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using Json = nlohmann::json;
using Corners = std::vector<std::vector<std::uint32_t>>;
using Positions = std::vector<std::vector<double>>;
using TexCoords = std::vector<std::vector<float>>;

class GltfReaderTest : public ::testing::Test {
 protected:
  PartsContent read_file(const std::string& path, std::size_t block_bytes = 1 << 16,
                         bool strict = false) const {
    return read_parts(
        [&](Warnings& warnings) {
          return GltfReader(path, {{1 << 20, 64}, block_bytes}, warnings);
        },
        strict);
  }

  PartsContent read(const std::string& glb, std::size_t block_bytes = 1 << 16) const {
    return read_file(dir_.write("model.glb", glb), block_bytes);
  }

  PartsContent read(GltfBuilder& gltf) const { return read(gltf.glb()); }

  std::string fault_of(GltfBuilder& gltf) const {
    return input_error_of([&] { read(gltf); });
  }

  TempDir dir_;
};

TEST_F(GltfReaderTest, TheCornersOfATriangleWithoutIndicesAreItsPositionsInOrder) {
  GltfBuilder gltf = one_triangle();
  const PartsContent content = read(gltf);
  ASSERT_EQ(content.parts.size(), 1U);
  EXPECT_EQ(positions_of(content.mesh()), (Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(corners_of(content.mesh()), (Corners{{0, 1, 2}}));
  EXPECT_EQ(content.mesh().faces[0].material, kNone<MaterialId>);
  EXPECT_EQ(content.mesh().faces[0].t[0], kNone<TexCoordId>);
  EXPECT_EQ(content.parts[0].promised.positions, 3U);
  EXPECT_EQ(content.parts[0].promised.faces, 1U);
  EXPECT_TRUE(content.messages.empty());
}

TEST_F(GltfReaderTest, IndicesOfEveryWidthNameTheSameCorners) {
  const std::vector<std::pair<int, std::string>> widths = {
      {GltfBuilder::kUnsignedByte, bytes_of<std::uint8_t>(2, 1, 0)},
      {GltfBuilder::kUnsignedShort, bytes_of<std::uint16_t>(2, 1, 0)},
      {GltfBuilder::kUnsignedInt, bytes_of<std::uint32_t>(2, 1, 0)}};
  for (const auto& [type, bytes] : widths) {
    GltfBuilder gltf;
    const std::size_t positions = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    gltf.show({{"attributes", {{"POSITION", positions}}},
               {"indices", gltf.accessor(bytes, type, "SCALAR", 3)}});
    EXPECT_EQ(corners_of(read(gltf).mesh()), (Corners{{2, 1, 0}})) << type;
  }
}

TEST_F(GltfReaderTest, EverySecondTriangleOfAStripIsTurnedAndAFanTurnsAboutItsFirst) {
  for (const auto& [mode, expected] : {std::pair{5, Corners{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}}},
                                       std::pair{6, Corners{{0, 1, 2}, {0, 2, 3}, {0, 3, 4}}}}) {
    GltfBuilder gltf;
    const std::size_t positions = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0, 0, 2, 0});
    gltf.show({{"attributes", {{"POSITION", positions}}}, {"mode", mode}});
    const PartsContent content = read(gltf);
    EXPECT_EQ(corners_of(content.mesh()), expected) << mode;
    EXPECT_EQ(content.parts[0].promised.faces, 3U);
  }
}

TEST_F(GltfReaderTest, FacesThatNameNoPositionAreDroppedAndCounted) {
  GltfBuilder gltf;
  const std::size_t positions = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  gltf.show({{"attributes", {{"POSITION", positions}}},
             {"indices", gltf.indices({0, 1, 3, 0, 1, 2, 255, 1, 2, 0, 1})}});
  const PartsContent content = read(gltf);
  EXPECT_EQ(corners_of(content.mesh()), (Corners{{0, 1, 2}}));
  EXPECT_EQ(content.parts[0].invalid_polygons, 3U) << "two faces, and two corners that are none";
  EXPECT_EQ(content.warnings.at("faces invalid"), 3U);
  EXPECT_TRUE(says(content.messages.at(0), "3 faces dropped from primitive 0 of mesh 0"));
}

TEST_F(GltfReaderTest, PointsAndLinesAreSkippedWithAWarning) {
  GltfBuilder gltf = one_triangle();
  for (const int mode : {0, 1, 2, 3}) {
    gltf.show({{"attributes", {{"POSITION", 0}}}, {"mode", mode}});
  }
  const PartsContent content = read(gltf);
  EXPECT_EQ(content.parts.size(), 1U);
  EXPECT_EQ(content.warnings.at("primitives skipped"), 4U);
}

TEST_F(GltfReaderTest, AModelOfPointsAloneIsAnError) {
  GltfBuilder gltf;
  gltf.show({{"attributes", {{"POSITION", gltf.positions({0, 0, 0})}}}, {"mode", 0}});
  EXPECT_TRUE(says(fault_of(gltf), "model.glb: found no triangles"));
}

TEST_F(GltfReaderTest, PositionsAreMovedByAllNodesAbove) {
  GltfBuilder gltf;
  const std::size_t mesh =
      gltf.mesh({{"attributes", {{"POSITION", gltf.positions({1, 2, 3, 1, 0, 0, 0, 1, 0})}}}});
  // A quarter turn about z, which maps x to y; then 10 along x.
  const double half = std::sqrt(0.5);
  gltf.add("nodes", {{"translation", {10, 0, 0}}, {"children", {1}}});
  gltf.add("nodes", {{"rotation", {0, 0, half, half}}, {"scale", {2, 3, 4}}, {"mesh", mesh}});
  gltf.add("scenes", {{"nodes", {0}}});
  const std::vector<Position> positions = read(gltf).mesh().positions;
  EXPECT_NEAR(positions[0].x, 10 - 6, 1e-14);
  EXPECT_NEAR(positions[0].y, 2, 1e-14);
  EXPECT_EQ(positions[0].z, 12);
}

TEST_F(GltfReaderTest, AMatrixIsReadColumnByColumn) {
  GltfBuilder gltf = one_triangle();
  gltf.document["nodes"][0]["matrix"] = {1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 20, 30, 1};
  EXPECT_EQ(positions_of(read(gltf).mesh()), (Positions{{10, 20, 30}, {11, 22, 33}, {14, 25, 36}}));
}

TEST_F(GltfReaderTest, UnderTheIdentityEveryBitStaysAsItIs) {
  GltfBuilder gltf;
  gltf.show({{"attributes",
              {{"POSITION", gltf.positions({0.1F, -0.0F, 1e-40F, INFINITY, 1, 0, 0, 1, 0})}}}});
  gltf.document["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  const PartsContent content = read(gltf);
  const std::vector<Position>& positions = content.mesh().positions;
  EXPECT_EQ(positions[0].x, static_cast<double>(0.1F));
  EXPECT_TRUE(std::signbit(positions[0].y));
  EXPECT_EQ(positions[0].z, static_cast<double>(1e-40F));
  EXPECT_EQ(positions[1].x, INFINITY);
  EXPECT_EQ(positions[1].y, 1) << "an infinity does not spread";
  EXPECT_EQ(content.warnings.at("coordinates not finite"), 1U);
}

TEST_F(GltfReaderTest, AMeshUnderTwoNodesIsTwoParts) {
  GltfBuilder gltf = one_triangle();
  gltf.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
  const PartsContent content = read(gltf);
  ASSERT_EQ(content.parts.size(), 2U);
  EXPECT_EQ(content.mesh(0).positions[0].x, 0);
  EXPECT_EQ(content.mesh(1).positions[0].x, 5);
  EXPECT_EQ(corners_of(content.mesh(1)), (Corners{{0, 1, 2}})) << "indices begin anew";
}

TEST_F(GltfReaderTest, AMirroringNodeTurnsItsTriangles) {
  GltfBuilder gltf = one_triangle();
  gltf.document["nodes"][0]["scale"] = {-1, 1, 1};
  EXPECT_EQ(corners_of(read(gltf).mesh()), (Corners{{0, 2, 1}}));
  gltf.document["nodes"][0]["scale"] = {-1, -1, 1};
  EXPECT_EQ(corners_of(read(gltf).mesh()), (Corners{{0, 1, 2}}));
}

TEST_F(GltfReaderTest, OnlyTheDefaultSceneIsShownElseTheFirstElseAllRoots) {
  GltfBuilder gltf = one_triangle();
  gltf.add("nodes", {{"mesh", 0}, {"translation", {5, 0, 0}}});
  gltf.add("nodes", {{"mesh", 0}, {"translation", {7, 0, 0}}});
  EXPECT_EQ(read(gltf).parts.size(), 3U);
  gltf.add("scenes", {{"nodes", {1}}});
  gltf.add("scenes", {{"nodes", {2, 0}}});
  EXPECT_EQ(read(gltf).mesh().positions[0].x, 5);
  gltf.document["scene"] = 1;
  const PartsContent content = read(gltf);
  ASSERT_EQ(content.parts.size(), 2U);
  EXPECT_EQ(content.mesh(0).positions[0].x, 7) << "in the order of the scene";
  EXPECT_EQ(content.mesh(1).positions[0].x, 0);
}

TEST_F(GltfReaderTest, ChildrenComeBeforeTheNextSibling) {
  GltfBuilder gltf = one_triangle();
  gltf.document["nodes"] = {{{"children", {1, 2}}},
                            {{"children", {3}}, {"mesh", 0}},
                            {{"mesh", 0}, {"translation", {2, 0, 0}}},
                            {{"mesh", 0}, {"translation", {3, 0, 0}}}};
  const PartsContent content = read(gltf);
  ASSERT_EQ(content.parts.size(), 3U);
  EXPECT_EQ(content.mesh(1).positions[0].x, 3);
  EXPECT_EQ(content.mesh(2).positions[0].x, 2);
}

TEST_F(GltfReaderTest, NodesThatAreNoTreeAreAnError) {
  GltfBuilder gltf = one_triangle();
  gltf.document["nodes"] = {{{"children", {1}}}, {{"children", {0}}, {"mesh", 0}}};
  EXPECT_TRUE(says(fault_of(gltf), "a cycle"));
  gltf.add("scenes", {{"nodes", {0}}});
  EXPECT_TRUE(says(fault_of(gltf), "node 0 is reached twice"));
  gltf.document["nodes"] = {{{"children", {1, 1}}}, {{"mesh", 0}}};
  EXPECT_TRUE(says(fault_of(gltf), "node 1 is reached twice"));
  gltf.document["nodes"] = {{{"children", {9}}}};
  EXPECT_TRUE(says(fault_of(gltf), "found node 9, but there are 1"));
}

TEST_F(GltfReaderTest, AMatrixThatIsNotAffineIsAnError) {
  GltfBuilder gltf = one_triangle();
  gltf.document["nodes"][0]["matrix"] = {1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_TRUE(says(fault_of(gltf), "nodes[0].matrix: expected an affine matrix"));
}

TEST_F(GltfReaderTest, SkinsAndMorphTargetsAreMeasuredAtRestWithAWarning) {
  GltfBuilder gltf = one_triangle();
  gltf.document["nodes"][0]["skin"] = 0;
  gltf.document["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", 0}}};
  const PartsContent content = read(gltf);
  EXPECT_EQ(content.parts.size(), 1U);
  EXPECT_EQ(content.warnings.at("rest pose"), 1U);
  EXPECT_TRUE(says(content.messages.at(0), "skins of 1 nodes and the morph targets of 1"));
}

TEST_F(GltfReaderTest, TheCenterOfCesiumMovesTheWholeScene) {
  GltfBuilder gltf = one_triangle();
  gltf.document["extensionsRequired"] = {"CESIUM_RTC"};
  gltf.document["extensions"]["CESIUM_RTC"]["center"] = {1e6, 2e6, 3e6};
  gltf.document["nodes"][0]["scale"] = {2, 2, 2};
  EXPECT_EQ(positions_of(read(gltf).mesh())[1], (std::vector<double>{1e6 + 2, 2e6, 3e6}));
}

TEST_F(GltfReaderTest, AnUnknownExtensionIsAnErrorOnlyIfItIsRequired) {
  GltfBuilder gltf = one_triangle();
  gltf.document["extensionsUsed"] = {"ACME_folded_space"};
  EXPECT_EQ(read(gltf).parts.size(), 1U);
  gltf.document["extensionsRequired"] = {"KHR_materials_unlit", "ACME_folded_space"};
  EXPECT_TRUE(says(fault_of(gltf),
                   "extensionsRequired[1]: the model requires the extension ACME_folded_space"));
  gltf.document["extensionsRequired"] = {"KHR_materials_unlit", "KHR_lights_punctual",
                                         "EXT_structural_metadata"};
  EXPECT_EQ(read(gltf).parts.size(), 1U);
}

TEST_F(GltfReaderTest, InstancingIsRefusedByName) {
  GltfBuilder gltf = one_triangle();
  gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = Json::object();
  EXPECT_TRUE(says(fault_of(gltf), "EXT_mesh_gpu_instancing"));
}

TEST_F(GltfReaderTest, MeshoptIsRefusedByNameAndTheRestIsMeasured) {
  GltfBuilder gltf = one_triangle();
  gltf.document["bufferViews"].push_back(gltf.document["bufferViews"][0]);
  gltf.document["bufferViews"][1]["extensions"]["EXT_meshopt_compression"]["buffer"] = 0;
  gltf.document["bufferViews"][1]["buffer"] = 1;
  gltf.add("accessors", gltf.document["accessors"][0]);
  gltf.document["accessors"][1]["bufferView"] = 1;
  gltf.show({{"attributes", {{"POSITION", 1}}}});
  gltf.document["buffers"] = {{{"byteLength", 36}}, {{"byteLength", 36}}};
  const PartsContent content = read(gltf);
  EXPECT_EQ(content.parts.size(), 1U);
  EXPECT_EQ(content.warnings.at("primitives unreadable"), 1U);
  EXPECT_TRUE(says(content.messages.at(0), "EXT_meshopt_compression"));

  gltf.document["nodes"].erase(0);
  EXPECT_TRUE(says(fault_of(gltf), "EXT_meshopt_compression"));

  dir_.write("fallback.bin", gltf.binary);
  gltf.document["buffers"][1]["uri"] = "fallback.bin";
  EXPECT_EQ(read(gltf).parts.size(), 1U) << "the fallback has bytes";
}

// Values of accessors.

TEST_F(GltfReaderTest, QuantizedPositionsAreNumbersOrFractionsOfTheLargest) {
  const auto positions_as = [&](const std::string& bytes, int type, bool normalized) {
    GltfBuilder gltf;
    gltf.show({{"attributes", {{"POSITION", gltf.accessor(bytes, type, "VEC3", 1, normalized)}}}});
    return positions_of(read(gltf).mesh()).at(0);
  };
  using Values = std::vector<double>;
  const auto bytes = bytes_of<std::int8_t>(-128, -127, 127);
  EXPECT_EQ(positions_as(bytes, GltfBuilder::kByte, false), (Values{-128, -127, 127}));
  EXPECT_EQ(positions_as(bytes, GltfBuilder::kByte, true), (Values{-1, -1, 1}));
  EXPECT_EQ(positions_as(bytes, GltfBuilder::kUnsignedByte, true),
            (Values{128.0 / 255, 129.0 / 255, 127.0 / 255}));
  const auto shorts = bytes_of<std::int16_t>(-32768, 16384, 1);
  EXPECT_EQ(positions_as(shorts, GltfBuilder::kShort, false), (Values{-32768, 16384, 1}));
  EXPECT_EQ(positions_as(shorts, GltfBuilder::kShort, true),
            (Values{-1, 16384.0 / 32767, 1.0 / 32767}));
  EXPECT_EQ(positions_as(shorts, GltfBuilder::kUnsignedShort, true),
            (Values{32768.0 / 65535, 16384.0 / 65535, 1.0 / 65535}));
}

TEST_F(GltfReaderTest, TheStepOfQuantizedPositionsIsStretchedByTheNode) {
  GltfBuilder gltf;
  const std::size_t positions =
      gltf.accessor(bytes_of<std::int16_t>(1, 2, 3), GltfBuilder::kShort, "VEC3", 1, true);
  const std::size_t texcoords =
      gltf.accessor(bytes_of<std::uint8_t>(1, 2), GltfBuilder::kUnsignedByte, "VEC2", 1, true);
  gltf.show(
      {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", texcoords}}}, {"material", 0}});
  gltf.document["nodes"][0]["scale"] = {1, 5, 2};
  gltf.document["materials"] = Json::parse(
      R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":
           {"KHR_texture_transform":{"scale":[2,3]}}}}}])");
  gltf.document["textures"] = Json::parse("[{}]");
  const std::optional<Quantization> quantization = read(gltf).parts[0].quantization;
  ASSERT_TRUE(quantization);
  EXPECT_EQ(quantization->position_bits, 16U);
  EXPECT_DOUBLE_EQ(quantization->position_step, 5.0 / 32767);
  EXPECT_EQ(quantization->uv_bits, 8U);
  EXPECT_DOUBLE_EQ(quantization->uv_step, 3.0 / 255);
}

TEST_F(GltfReaderTest, FloatsAreNotQuantized) {
  GltfBuilder gltf = one_triangle();
  EXPECT_FALSE(read(gltf).parts[0].quantization);
}

class GltfTexCoordTest : public GltfReaderTest {
 protected:
  TexCoords texcoords_as(const std::string& bytes, int type, std::size_t count, bool normalized) {
    GltfBuilder gltf;
    const std::size_t positions = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
    gltf.show({{"attributes",
                {{"POSITION", positions},
                 {"TEXCOORD_0", gltf.accessor(bytes, type, "VEC2", count, normalized)}}}});
    return texcoords_of(read(gltf).mesh());
  }
};

TEST_F(GltfTexCoordTest, VIsTurnedInFloatAndMinusZeroBecomesZero) {
  const auto read = texcoords_as(bytes_of(-0.0F, 0.1F, 0.25F, 1.0F), GltfBuilder::kFloat, 2, false);
  EXPECT_EQ(read, (TexCoords{{0, 1.0F - 0.1F}, {0.25F, 0}}));
  EXPECT_FALSE(std::signbit(read[0][0]));
  EXPECT_FALSE(std::signbit(read[1][1]));
}

TEST_F(GltfTexCoordTest, IntegersAreFractionsOrNumbersByTheQuantizationExtension) {
  const auto shorts = bytes_of<std::uint16_t>(65535, 0);
  EXPECT_EQ(texcoords_as(shorts, GltfBuilder::kUnsignedShort, 1, true), (TexCoords{{1, 1}}));
  EXPECT_EQ(texcoords_as(shorts, GltfBuilder::kUnsignedShort, 1, false), (TexCoords{{65535, 1}}));
  EXPECT_EQ(texcoords_as(bytes_of<std::int8_t>(-127, 64), GltfBuilder::kByte, 1, true),
            (TexCoords{{-1, 1.0F - static_cast<float>(64.0 / 127)}}));
  EXPECT_EQ(texcoords_as(bytes_of<std::int16_t>(-2, 3), GltfBuilder::kShort, 1, false),
            (TexCoords{{-2, -2}}));
}

TEST_F(GltfTexCoordTest, CornersBeyondTheTextureCoordinatesHaveNone) {
  GltfBuilder gltf;
  const std::size_t positions = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  gltf.show(
      {{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", gltf.texcoords({0, 0, 1, 1})}}}});
  const PartsContent content = read(gltf);
  EXPECT_EQ(content.mesh().faces[0].t[1], TexCoordId{1});
  EXPECT_EQ(content.mesh().faces[0].t[2], kNone<TexCoordId>);
}

TEST_F(GltfReaderTest, ElementsMayLieApartInTheirView) {
  GltfBuilder gltf;
  const std::string rows = bytes_of<float>(0, 0, 0, 9, 1, 0, 0, 9, 0, 1, 0);  // the last is short
  gltf.add("accessors", {{"bufferView", gltf.view(rows, 16)},
                         {"componentType", GltfBuilder::kFloat},
                         {"type", "VEC3"},
                         {"count", 3}});
  gltf.show({{"attributes", {{"POSITION", 0}}}});
  EXPECT_EQ(positions_of(read(gltf).mesh()), (Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
}

TEST_F(GltfReaderTest, SparseElementsReplaceThoseBelowThemOrZeros) {
  for (const bool has_base : {true, false}) {
    GltfBuilder gltf;
    const std::size_t accessor = gltf.positions({1, 1, 1, 2, 2, 2, 3, 3, 3, 4, 4, 4});
    Json& positions = gltf.document["accessors"][accessor];
    if (!has_base) positions.erase("bufferView");
    positions["sparse"] = {
        {"count", 2},
        {"indices",
         {{"bufferView", gltf.view(bytes_of<std::uint16_t>(1, 3))},
          {"componentType", GltfBuilder::kUnsignedShort}}},
        {"values", {{"bufferView", gltf.view(bytes_of<float>(7, 8, 9, 5, 6, 7))}}}};
    gltf.show({{"attributes", {{"POSITION", accessor}}}});
    for (const std::size_t block_bytes : {1U, 512U, 65536U}) {
      const double base = has_base ? 1 : 0;
      EXPECT_EQ(
          positions_of(read(gltf.glb(), block_bytes).mesh()),
          (Positions{{base, base, base}, {7, 8, 9}, {base * 3, base * 3, base * 3}, {5, 6, 7}}))
          << block_bytes;
    }
  }
}

TEST_F(GltfReaderTest, SparseIndicesThatDoNotAscendAreAnErrorBeforeAnyValue) {
  for (const auto& indices :
       {bytes_of<std::uint8_t>(2, 1), bytes_of<std::uint8_t>(1, 1), bytes_of<std::uint8_t>(1, 3)}) {
    GltfBuilder gltf = one_triangle();
    gltf.document["accessors"][0]["sparse"] = {
        {"count", 2},
        {"indices",
         {{"bufferView", gltf.view(indices)}, {"componentType", GltfBuilder::kUnsignedByte}}},
        {"values", {{"bufferView", gltf.view(bytes_of<float>(7, 8, 9, 5, 6, 7))}}}};
    const std::string path = dir_.write("model.glb", gltf.glb());
    Warnings warnings(nullptr);
    GltfReader reader(path, {}, warnings);
    const std::unique_ptr<MeshPart> part = reader.next();
    EXPECT_TRUE(says(input_error_of([&] { part->load(); }),
                     "the sparse indices of accessor 0 do not ascend"));
  }
}

TEST_F(GltfReaderTest, TheSizeOfBlocksChangesNothing) {
  GltfBuilder gltf;
  std::vector<float> positions;
  std::vector<float> texcoords;
  std::vector<std::uint8_t> indices;
  for (std::uint8_t i = 0; i < 100; ++i) {
    positions.insert(positions.end(), {static_cast<float>(i), 1, 2});
    texcoords.insert(texcoords.end(), {static_cast<float>(i), 0.5F});
    indices.push_back(static_cast<std::uint8_t>(i * 7 % 100));
  }
  gltf.show({{"attributes",
              {{"POSITION", gltf.positions(positions)}, {"TEXCOORD_0", gltf.texcoords(texcoords)}}},
             {"indices", gltf.indices(indices)},
             {"mode", 5}});
  const PartsContent whole = read(gltf.glb());
  ASSERT_EQ(whole.mesh().faces.size(), 98U);
  for (const std::size_t block_bytes : {1U, 1000U, 5000U}) {
    const PartsContent cut = read(gltf.glb(), block_bytes);
    EXPECT_EQ(positions_of(cut.mesh()), positions_of(whole.mesh()));
    EXPECT_EQ(texcoords_of(cut.mesh()), texcoords_of(whole.mesh()));
    EXPECT_EQ(corners_of(cut.mesh()), corners_of(whole.mesh()));
    EXPECT_GT(cut.parts[0].batches, 2U);
    EXPECT_LT(cut.parts[0].memory_bytes, whole.parts[0].memory_bytes);
  }
}

// Draco: the box of twelve triangles that the codec's own examples hold.

class GltfDracoTest : public GltfReaderTest {
 protected:
  /// A glTF of a Draco stream as the only buffer view.
  static GltfBuilder of_stream(const std::string& stream, const Json& attributes) {
    GltfBuilder gltf;
    const std::size_t view = gltf.view(stream);
    Json primitive = {{"attributes", {{"POSITION", 0}}}};
    primitive["extensions"]["KHR_draco_mesh_compression"] = {{"bufferView", view},
                                                             {"attributes", attributes}};
    gltf.document["extensionsRequired"] = {"KHR_draco_mesh_compression"};
    gltf.show(primitive);
    return gltf;
  }

  static std::string stream() {
    const std::string path =
        ATLASGAUGE_SOURCE_DIR "/../shared/data/draco/cube_att.obj.edgebreaker.cl4.2.2.drc";
    return std::filesystem::exists(path) ? read_range(whole_file(path)) : std::string();
  }
};

TEST_F(GltfDracoTest, AStreamIsDecodedPlacedTurnedAndItsTextureCoordinatesTooAndSteps) {
  if (stream().empty()) GTEST_SKIP() << "SKIPPED: no Draco streams beside this checkout";
  GltfBuilder gltf = of_stream(stream(), {{"POSITION", 0}, {"TEXCOORD_0", 1}});
  const PartsContent plain = read(gltf);
  gltf.document["nodes"][0]["scale"] = {-2, 3, 1};
  const PartsContent placed = read(gltf);
  ASSERT_EQ(plain.mesh().faces.size(), 12U);
  ASSERT_FALSE(plain.mesh().texcoords.empty());
  for (std::size_t i = 0; i < plain.mesh().positions.size(); ++i) {
    EXPECT_EQ(placed.mesh().positions[i].x, -2 * plain.mesh().positions[i].x);
    EXPECT_EQ(placed.mesh().positions[i].y, 3 * plain.mesh().positions[i].y);
  }
  EXPECT_EQ(placed.mesh().faces[0].v[1], plain.mesh().faces[0].v[2]) << "the node mirrors";
  EXPECT_EQ(placed.mesh().faces[0].t[1], plain.mesh().faces[0].t[2]);
  const DracoMesh decoded = DracoMesh::decode(stream(), {0, 1, false}, "cube_att.drc");
  EXPECT_EQ(plain.mesh().texcoords[1].v, 1.0F - decoded.texcoord(1).v);
  EXPECT_EQ(placed.parts[0].quantization.value().position_step,
            3 * plain.parts[0].quantization.value().position_step);
  EXPECT_GT(plain.parts[0].memory_bytes, stream().size());
}

TEST_F(GltfDracoTest, WhatIsNoStreamIsAnErrorBeforeItIsLoaded) {
  GltfBuilder gltf = of_stream("DRACO but not really", {{"POSITION", 0}});
  EXPECT_TRUE(says(fault_of(gltf), "model.glb: "));
  EXPECT_TRUE(says(fault_of(gltf), "Draco"));
  gltf.document["bufferViews"][0]["byteLength"] = 2000;
  EXPECT_TRUE(says(fault_of(gltf), "a Draco stream needs 2000 bytes"));
}

TEST_F(GltfDracoTest, AttributesThatTheStreamDoesNotHaveAreAnErrorOfLoading) {
  if (stream().empty()) GTEST_SKIP() << "SKIPPED: no Draco streams beside this checkout";
  GltfBuilder gltf = of_stream(stream(), {{"POSITION", 77}});
  EXPECT_TRUE(says(fault_of(gltf), "model.glb: "));
}

// Where the bytes are.

TEST_F(GltfReaderTest, BuffersMayBeFilesNamedByUris) {
  GltfBuilder gltf = one_triangle();
  gltf.document["buffers"] = {{{"byteLength", 36}, {"uri", "two%20words.bin"}}};
  dir_.write("two words.bin", gltf.binary);
  const std::string path = dir_.write("model.gltf", gltf.document.dump());
  EXPECT_EQ(positions_of(read_file(path).mesh())[1], (std::vector<double>{1, 0, 0}));

  gltf.document["buffers"][0]["uri"] = (dir_.path() / "two words.bin").string();
  EXPECT_EQ(read_file(dir_.write("deep/model.gltf", gltf.document.dump())).parts.size(), 1U);
  gltf.document["buffers"][0]["uri"] = "../two words.bin";
  EXPECT_EQ(read_file(dir_.write("deep/model.gltf", gltf.document.dump())).parts.size(), 1U);
}

TEST_F(GltfReaderTest, BuffersMayBeInTheDocument) {
  GltfBuilder gltf = one_triangle();
  gltf.document["buffers"] = {
      {{"byteLength", 36}, {"uri", "data:application/octet-stream;base64," + base64(gltf.binary)}}};
  const std::string path = dir_.write("model.gltf", gltf.document.dump());
  EXPECT_EQ(positions_of(read_file(path, 1).mesh()), (Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  gltf.document["buffers"][0]["uri"] = "data:;base64,A*==";
  EXPECT_TRUE(says(input_error_of([&] { read_file(dir_.write("m.gltf", gltf.document.dump())); }),
                   "buffers[0].uri: found a data: URI whose base64 is broken"));
}

TEST_F(GltfReaderTest, WhatReachesBeyondItsBufferIsAnErrorThatSaysHowFar) {
  GltfBuilder gltf = one_triangle();
  gltf.document["accessors"][0]["count"] = 4;
  EXPECT_TRUE(
      says(fault_of(gltf), "accessor 0 needs 48 bytes from 0 on of its buffer view, which has 36"));
  gltf = one_triangle();
  gltf.document["accessors"][0]["byteOffset"] = 1;
  EXPECT_TRUE(says(fault_of(gltf), "accessor 0 needs 36 bytes from 1 on"));
  gltf = one_triangle();
  gltf.document["bufferViews"][0]["byteOffset"] = std::uint64_t{1} << 63;
  EXPECT_TRUE(says(fault_of(gltf), "of buffer 0, which has 36"));
  gltf = one_triangle();
  gltf.document["buffers"] = {{{"byteLength", 40}}};
  EXPECT_TRUE(says(fault_of(gltf), "buffer 0 should have 40 bytes, but has 36"));
  gltf = one_triangle();
  gltf.document["buffers"] = {{{"byteLength", 36}, {"uri", "missing.bin"}}};
  EXPECT_TRUE(says(fault_of(gltf), "missing.bin: cannot open"));
  gltf.document["buffers"][0]["uri"] = "https://example.org/a.bin";
  EXPECT_TRUE(says(fault_of(gltf), "which is no file"));
}

TEST_F(GltfReaderTest, ElementsOfTheWrongKindAreAnError) {
  GltfBuilder gltf = one_triangle();
  gltf.document["accessors"][0]["type"] = "VEC2";
  EXPECT_TRUE(says(fault_of(gltf), "accessor 0 holds positions, expected 3 components"));
  gltf = one_triangle();
  gltf.document["meshes"][0]["primitives"][0]["indices"] = 0;
  EXPECT_TRUE(says(fault_of(gltf), "accessor 0 holds indices, expected scalars"));
  gltf = one_triangle();
  gltf.document["accessors"][0]["componentType"] = 5124;
  EXPECT_TRUE(says(fault_of(gltf), "accessors[0].componentType: expected one of 5120"));
  gltf = one_triangle();
  gltf.document["accessors"][0]["count"] = -1;
  EXPECT_TRUE(says(fault_of(gltf), "accessors[0].count: expected a whole number"));
  gltf = one_triangle();
  gltf.document["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = 7;
  EXPECT_TRUE(says(fault_of(gltf), "a primitive names accessor 7, but there are 1"));
}

TEST_F(GltfReaderTest, GltfOfOtherVersionsAndOtherFilesAreErrors) {
  GltfBuilder gltf = one_triangle();
  gltf.document["asset"]["version"] = "1.0";
  EXPECT_TRUE(says(fault_of(gltf), "found glTF 1.0, expected 2.0"));
  std::string old = one_triangle().glb();
  old[4] = 1;
  EXPECT_TRUE(says(input_error_of([&] { read(old); }), "found a binary glTF 1.0"));
  EXPECT_TRUE(says(input_error_of([&] { read("{}"); }), "this is no glTF"));
  EXPECT_TRUE(says(input_error_of([&] { read("v 0 0 0\n"); }), "found broken JSON"));
  EXPECT_TRUE(says(input_error_of([&] { read(""); }), "found broken JSON"));
  EXPECT_TRUE(says(input_error_of([&] { read_file(dir_.path().string()); }), "found a folder"));
}

TEST_F(GltfReaderTest, AJsonBeyondTheLimitIsRefusedBeforeItIsRead) {
  GltfBuilder gltf = one_triangle();
  const std::string path = dir_.write("model.glb", gltf.glb());
  Warnings warnings(nullptr);
  try {
    const GltfReader reader(path, {{100, 64}, 1024}, warnings);
    FAIL() << "it was read";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
    EXPECT_TRUE(says(error.what(), "takes more than 100 bytes of memory"));
  }
}

TEST_F(GltfReaderTest, EveryTruncationIsAnErrorOrAValue) {
  GltfBuilder gltf = one_triangle();
  const std::string glb = gltf.glb();
  for (std::size_t bytes = 0; bytes < glb.size(); ++bytes) {
    EXPECT_TRUE(says(input_error_of([&] { read(glb.substr(0, bytes)); }), "model.glb: ")) << bytes;
  }
}

/// Replaces each value of a document in turn.
template <class Try>
void replace_each(Json& document, Json& value, const Try& attempt) {
  for (const Json& hostile :
       {Json(), Json(-1), Json(1e300), Json(0.5), Json(std::uint64_t{1} << 63), Json("x"),
        Json::array(), Json::object(), Json(4294967295U), Json(0), Json(2), Json(true)}) {
    const Json kept = std::exchange(value, hostile);
    attempt(document);
    value = kept;
  }
  if (!value.is_structured()) return;
  for (Json& element : value) replace_each(document, element, attempt);
}

TEST_F(GltfReaderTest, EveryHostileValueIsAnErrorOrAValue) {
  GltfBuilder gltf;
  const std::size_t positions = gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0});
  gltf.document["accessors"][positions]["sparse"] = {
      {"count", 1},
      {"indices",
       {{"bufferView", gltf.view(bytes_of<std::uint8_t>(1))},
        {"componentType", GltfBuilder::kUnsignedByte}}},
      {"values", {{"bufferView", gltf.view(bytes_of<float>(7, 8, 9))}}}};
  gltf.show({{"attributes", {{"POSITION", positions}, {"TEXCOORD_0", gltf.texcoords({0, 0})}}},
             {"indices", gltf.indices({0, 1, 2})},
             {"material", 0}});
  gltf.document["nodes"][0]["scale"] = {1, 1, 1};
  gltf.document["materials"] = Json::parse(
      R"([{"pbrMetallicRoughness":{"baseColorTexture":{"index":0,"extensions":
           {"KHR_texture_transform":{"scale":[2,3],"texCoord":0}}}}}])");
  gltf.document["textures"] = {{{"source", 0}}};
  gltf.document["images"] = {{{"bufferView", 0}}};
  gltf.glb();
  std::size_t errors = 0;
  std::size_t values = 0;
  replace_each(gltf.document, gltf.document, [&](const Json& document) {
    // A count of millions of zeros is right, but slow.
    const std::string glb = make_glb(document.dump(), gltf.binary);
    try {
      read(glb);
      ++values;
    } catch (const Error& error) {
      ++errors;
      EXPECT_TRUE(error.kind() == ErrorKind::kInput || error.kind() == ErrorKind::kResource)
          << error.what();
    }
  });
  EXPECT_GT(errors, 300U);
  EXPECT_GT(values, 50U);
}

}  // namespace
}  // namespace atlasgauge
