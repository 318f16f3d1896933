#include "io/tiles/tile_content.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "io/tiles/b3dm_reader.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/input_error.hpp"
#include "tests/support/mesh_values.hpp"
#include "tests/support/read_parts.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using Positions = std::vector<std::vector<double>>;

std::string triangle() {
  return one_triangle().glb();
}

PartsContent read_b3dm(const std::string& tile) {
  const TempDir dir;
  const std::string path = dir.write("a.b3dm", tile);
  return read_parts([&](Warnings& warnings) {
    return B3dmReader(path, {{1 << 20, 64}, 1024}, warnings);
  });
}

/// The beginnings of the glTF in a tile.
std::vector<std::string> gltf_in(const std::string& tile, Warnings& warnings) {
  std::vector<std::string> found;
  for (const TileGltf& gltf : find_in_tile(bytes_in_memory(tile, "tile"), {}, warnings)) {
    found.push_back(read_range(gltf.gltf));
  }
  return found;
}

std::vector<std::string> gltf_in(const std::string& tile) {
  Warnings warnings(nullptr);
  return gltf_in(tile, warnings);
}

std::string fault_in(const std::string& tile) {
  return input_error_of([&] { gltf_in(tile); });
}

TEST(TileContentTest, ALoneTileKeepsItsAxesAndAddsItsCenter) {
  EXPECT_EQ(positions_of(read_b3dm(make_b3dm(triangle())).mesh()),
            (Positions{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(positions_of(read_b3dm(make_b3dm(triangle(), R"({"RTC_CENTER":[1e6,2,3]})")).mesh()),
            (Positions{{1e6, 2, 3}, {1e6 + 1, 2, 3}, {1e6, 3, 3}}));
}

TEST(TileContentTest, TheCenterMayLieInTheBinaryOfTheFeatureTable) {
  const std::string binary = u32_bytes(0) + bytes_of<float>(4, 5, 6);
  EXPECT_EQ(
      positions_of(
          read_b3dm(make_b3dm(triangle(), R"({"RTC_CENTER":{"byteOffset":4}})", binary)).mesh())[0],
      (std::vector<double>{4, 5, 6}));
  EXPECT_TRUE(says(fault_in(make_b3dm(triangle(), R"({"RTC_CENTER":{"byteOffset":5}})", binary)),
                   "RTC_CENTER lies at byte 5 of the feature table, which has 16"));
}

TEST(TileContentTest, OlderHeadersAreUnderstood) {
  const std::string glb = triangle();
  const std::string batches = R"({"id":[1]}  )";
  // batchLength, batchTableByteLength
  const std::string header20 =
      "b3dm" + u32_bytes(1) + u32_bytes(20 + glb.size()) + u32_bytes(0) + u32_bytes(0);
  EXPECT_EQ(gltf_in(header20 + glb), (std::vector<std::string>{glb}));
  const std::string quoted = "\"id\"    ";
  const std::string with_table = "b3dm" + u32_bytes(1) +
                                 u32_bytes(20 + quoted.size() + glb.size()) + u32_bytes(1) +
                                 u32_bytes(quoted.size());
  EXPECT_EQ(gltf_in(with_table + quoted + glb), (std::vector<std::string>{glb}));
  // batchTableJSONByteLength, batchTableBinaryByteLength, batchLength
  const std::string header24 = "b3dm" + u32_bytes(1) +
                               u32_bytes(24 + batches.size() + 4 + glb.size()) +
                               u32_bytes(batches.size()) + u32_bytes(4) + u32_bytes(1);
  EXPECT_EQ(gltf_in(header24 + batches + "BIN!" + glb), (std::vector<std::string>{glb}));
}

TEST(TileContentTest, ACompositeIsItsTilesInOrder) {
  const std::string one = make_b3dm(triangle());
  const std::string two = make_b3dm(triangle() + "padding ");
  const std::string three = make_b3dm(triangle() + "more    ");
  EXPECT_EQ(
      gltf_in(make_cmpt(one, make_cmpt(two), three)),
      (std::vector<std::string>{triangle(), triangle() + "padding ", triangle() + "more    "}));
}

TEST(TileContentTest, PointsAndInstancesAreSkippedWithAWarning) {
  Warnings warnings(nullptr);
  const std::string points = "pnts" + u32_bytes(1) + u32_bytes(16) + "....";
  const std::string instances = "i3dm" + u32_bytes(1) + u32_bytes(16) + "....";
  EXPECT_EQ(gltf_in(make_cmpt(points, make_b3dm(triangle()), instances), warnings).size(), 1U);
  EXPECT_EQ(warnings.totals().at("tiles skipped"), 2U);
}

TEST(TileContentTest, OtherFilesAreErrors) {
  EXPECT_TRUE(says(fault_in(""), "found no tile that is known here"));
  EXPECT_TRUE(says(fault_in("vctr"), "found a file beginning with 'v'"));
  EXPECT_TRUE(says(fault_in("\x1F\x8B\x08"), "compressed by gzip"));
  std::string newer = make_b3dm(triangle());
  newer[4] = 2;
  EXPECT_TRUE(says(fault_in(newer), "found a tile (b3dm) of version 2, expected 1"));
}

TEST(TileContentTest, GltfOfTheFirstVersionIsRefusedByName) {
  std::string glb = triangle();
  glb[4] = 1;
  EXPECT_TRUE(says(input_error_of([&] { read_b3dm(make_b3dm(glb)); }), "found a binary glTF 1.0"));
}

TEST(TileContentTest, EveryTruncationIsAnError) {
  const std::string tile = make_b3dm(triangle(), R"({"RTC_CENTER":[1,2,3]})");
  const std::string composite = make_cmpt(tile, tile);
  for (std::size_t bytes = 0; bytes < tile.size(); ++bytes) {
    EXPECT_TRUE(says(input_error_of([&] { read_b3dm(tile.substr(0, bytes)); }), "a.b3dm: "));
  }
  for (std::size_t bytes = 0; bytes < composite.size(); ++bytes) {
    EXPECT_TRUE(says(fault_in(composite.substr(0, bytes)), "tile: "));
  }
}

TEST(TileContentTest, EveryHostileLengthIsAnErrorOrATile) {
  const std::string tile = make_b3dm(triangle(), R"({"RTC_CENTER":[1,2,3]})");
  const std::string composite = make_cmpt(tile, tile);
  for (const std::uint32_t length : {0U, 1U, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
    for (std::size_t at = 0; at + 4 <= 60; at += 4) {
      std::string hostile = composite;
      hostile.replace(at, 4, bytes_of(length));
      EXPECT_NO_THROW(fault_in(hostile)) << at;
      hostile = tile;
      hostile.replace(at, 4, bytes_of(length));
      EXPECT_NO_THROW(input_error_of([&] { read_b3dm(hostile); })) << at;
    }
  }
}

}  // namespace
}  // namespace atlasgauge
