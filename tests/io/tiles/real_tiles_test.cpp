#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "io/file/byte_source.hpp"
#include "io/gltf/gltf_reader.hpp"
#include "io/tiles/b3dm_reader.hpp"
#include "io/tiles/tileset_reader.hpp"
#include "tests/support/obj_text.hpp"
#include "tests/support/read_parts.hpp"

// Models that others made, where they lie beside this checkout.
namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

fs::path data_folder() {
  return fs::path(ATLASGAUGE_SOURCE_DIR).parent_path() / "shared/data";
}

#define SKIP_WITHOUT(path) \
  if (!fs::exists(path)) GTEST_SKIP() << "SKIPPED: no " << (path) << " beside this checkout"

PartsContent read_tileset(const fs::path& path, std::optional<std::uint32_t> cut = {}) {
  return read_parts(
      [&](Warnings& warnings) { return TilesetReader(path.string(), cut, {}, warnings); });
}

struct Totals {
  std::uint64_t parts = 0, positions = 0, texcoords = 0, faces = 0, images = 0;
  bool operator==(const Totals&) const = default;
};

std::ostream& operator<<(std::ostream& out, const Totals& totals) {
  return out << totals.parts << " parts, " << totals.positions << " positions, " << totals.texcoords
             << " texcoords, " << totals.faces << " faces, " << totals.images << " images";
}

Totals totals_of(const PartsContent& content) {
  Totals totals;
  totals.parts = content.parts.size();
  totals.images = content.materials.images.size();
  for (const PartContent& part : content.parts) {
    totals.positions += part.mesh.positions.size();
    totals.texcoords += part.mesh.texcoords.size();
    totals.faces += part.mesh.faces.size();
  }
  return totals;
}

TEST(RealTilesTest, LeavesOfATilesetAreTheirTwinInObj) {
  const fs::path tiles = data_folder() / "nasa_3dtilesrenderer/data/tileset.json";
  const fs::path twin = data_folder() / "derived/nasa_tiles_leaves/nasa_leaves.obj";
  SKIP_WITHOUT(tiles);
  SKIP_WITHOUT(twin);
  const PartsContent content = read_tileset(tiles);
  const std::unique_ptr<ByteSource> source = open_byte_source(twin.string());
  const ObjContent obj = read_obj(*source);
  ASSERT_EQ(totals_of(content), (Totals{220, obj.mesh.positions.size(), obj.mesh.texcoords.size(),
                                        obj.mesh.faces.size(), 220}));
  // The twin has seven digits.
  double furthest = 0;
  double furthest_uv = 0;
  std::size_t position = 0, texcoord = 0, face = 0, different = 0;
  for (const PartContent& part : content.parts) {
    const auto base = static_cast<std::uint32_t>(position);
    for (const FaceRecord& f : part.mesh.faces) {
      const FaceRecord& other = obj.mesh.faces[face++];
      for (int corner = 0; corner < 3; ++corner) {
        if (raw(f.v[corner]) + base != raw(other.v[corner])) ++different;
        if (raw(f.t[corner]) + base != raw(other.t[corner])) ++different;
      }
    }
    for (const Position& p : part.mesh.positions) {
      const Position& other = obj.mesh.positions[position++];
      furthest = std::max(
          {furthest, std::abs(p.x - other.x), std::abs(p.y - other.y), std::abs(p.z - other.z)});
    }
    for (const TexCoord& t : part.mesh.texcoords) {
      const TexCoord& other = obj.mesh.texcoords[texcoord++];
      furthest_uv = std::max({furthest_uv, static_cast<double>(std::abs(t.u - other.u)),
                              static_cast<double>(std::abs(t.v - other.v))});
    }
  }
  EXPECT_EQ(different, 0U) << "the tiles, and the faces in them, are in the same order";
  EXPECT_LT(furthest, 5.1e-5);
  EXPECT_LT(furthest_uv, 1.2e-7);
}

TEST(RealTilesTest, TheSameTilesetCutIntoFilesIsTheSameModel) {
  const fs::path folder = data_folder() / "nasa_3dtilesrenderer/data";
  SKIP_WITHOUT(folder);
  const Totals leaves{220, 132064, 132064, 177950, 220};
  for (const char* const name : {"tileset-external.json", "tileset-external-with-url-params.json",
                                 "tileset-no-root-content.json", "tileset-no-midtile-content.json",
                                 "tileset-broken-root-content.json"}) {
    const PartsContent content = read_tileset(folder / name);
    EXPECT_EQ(totals_of(content), leaves) << name;
    EXPECT_TRUE(content.messages.empty()) << name;
  }
  const PartsContent broken = read_tileset(folder / "tileset-external-broken.json");
  EXPECT_EQ(broken.warnings.at("tiles unreadable"), 1U);
  EXPECT_EQ(totals_of(broken).parts, 204U);
  EXPECT_EQ(totals_of(read_tileset(folder / "tileset-add.json")).parts, 293U);
  for (std::uint32_t cut = 0; cut < 5; ++cut) {
    EXPECT_EQ(totals_of(read_tileset(folder / "tileset.json", cut)),
              totals_of(read_tileset(folder / "tileset-external.json", cut)));
  }
}

TEST(RealTilesTest, ModelsOfOthersAreReadWhole) {
  struct Case {
    const char* file;
    Totals totals;
  };
  const Case cases[] = {
      {"draco/Box/glTF/Box.gltf", {1, 24, 0, 12, 0}},
      {"draco/Box/glTF_Binary/Box.glb", {1, 24, 0, 12, 0}},
      {"draco/Box/glTF_Binary/Box_Draco.glb", {1, 24, 0, 12, 0}},
      {"draco/BoxMetaDraco/glTF/BoxMetaDraco.gltf", {1, 8, 8, 12, 0}},
      {"loadersgl/gltf/test/data/3d-tiles/tile.glb", {2, 6862, 8363, 9439, 2}},
      {"loadersgl/3d-tiles/test/data/143.b3dm", {2, 18606, 21545, 28222, 2}},
      {"loadersgl/tile-converter/test/data/Frankfurt/L5/OF/474_5548_-1_lv5_group_0.osgb_3.b3dm",
       {1, 53803, 53803, 49427, 1}},
  };
  SKIP_WITHOUT(data_folder());
  for (const auto& [file, totals] : cases) {
    const std::string path = (data_folder() / file).string();
    const PartsContent content =
        is_b3dm(whole_file(path))
            ? read_parts([&](Warnings& warnings) { return B3dmReader(path, {}, warnings); })
            : read_parts([&](Warnings& warnings) { return GltfReader(path, {}, warnings); });
    EXPECT_EQ(totals_of(content), totals) << file;
    EXPECT_TRUE(content.messages.empty()) << file;
  }
}

}  // namespace
}  // namespace atlasgauge
