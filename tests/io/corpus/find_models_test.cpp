#include "io/corpus/find_models.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/support/input_error.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;
using Paths = std::vector<std::string>;

class FindModelsTest : public testing::Test {
 protected:
  Paths found(Paths patterns = {}, const std::string& left_out = "") {
    return find_models({dir_.path().string(), std::move(patterns), left_out}).paths;
  }
  void make(const Paths& names) {
    for (const std::string& name : names) dir_.write(name, "");
  }

  TempDir dir_;
};

TEST_F(FindModelsTest, FormatsAreKnownByTheirNames) {
  make({"a.obj", "a.mtl", "a.png", "b.OBJ.gz", "c.ply", "d.drc", "e/f.gltf", "e/f.bin", "e/g.glb",
        "h.b3dm", "metadata.json", "obj"});
  EXPECT_EQ(found(),
            (Paths{"a.obj", "b.OBJ.gz", "c.ply", "d.drc", "e/f.gltf", "e/g.glb", "h.b3dm"}));
}

TEST_F(FindModelsTest, TheOrderIsThatOfTheBytes) {
  make({"b.obj", "a/z.obj", "a.obj", "B.obj", "a-1.obj"});
  EXPECT_EQ(found(), (Paths{"B.obj", "a-1.obj", "a.obj", "a/z.obj", "b.obj"}));
}

TEST_F(FindModelsTest, ATilesetIsOneModelWithAllBelowIt) {
  make({"site/tileset.json", "site/0.b3dm", "site/deep/1.glb", "other/2.glb"});
  EXPECT_EQ(found(), (Paths{"other/2.glb", "site/tileset.json"}));
}

TEST_F(FindModelsTest, ATilesetMayLieInTheRoot) {
  make({"tileset.json", "0.b3dm"});
  EXPECT_EQ(found(), Paths{"tileset.json"});
}

TEST_F(FindModelsTest, APatternIsForNamesAndWithASlashForPaths) {
  make({"RWT1/a.obj", "RWT1/b.ply", "RWT2/a.obj", "x/tileset.json", "x/0.b3dm"});
  EXPECT_EQ(found({"*.obj"}), (Paths{"RWT1/a.obj", "RWT2/a.obj"}));
  EXPECT_EQ(found({"RWT1/*"}), (Paths{"RWT1/a.obj", "RWT1/b.ply"}));
  EXPECT_EQ(found({"*/0.b3dm", "b.*"}), (Paths{"RWT1/b.ply", "x/0.b3dm"}));
}

TEST_F(FindModelsTest, TheFolderOfTheJobIsNotSearched) {
  make({"a.obj", "job/results/b.obj"});
  EXPECT_EQ(found({}, (dir_.path() / "." / "job").string()), Paths{"a.obj"});
}

TEST_F(FindModelsTest, FoldersWithNamesOfModelsAreNone) {
  make({"a.obj/b.ply"});
  EXPECT_EQ(found(), Paths{"a.obj/b.ply"});
}

TEST_F(FindModelsTest, LinksToFilesAreModelsAndLinksToFoldersAreNotFollowed) {
  make({"real/a.obj"});
  fs::create_symlink("real/a.obj", dir_.path() / "b.obj");
  fs::create_symlink("missing", dir_.path() / "c.obj");
  fs::create_symlink(".", dir_.path() / "loop");
  EXPECT_EQ(found(), (Paths{"b.obj", "real/a.obj"}));
}

TEST_F(FindModelsTest, NamesOfAnyBytesAreFound) {
  make({"a\tb\n\xFF.obj"});
  EXPECT_EQ(found(), Paths{"a\tb\n\xFF.obj"});
}

TEST_F(FindModelsTest, AMissingRootIsAnError) {
  EXPECT_TRUE(says(input_error_of([&] {
                     find_models({(dir_.path() / "none").string(), {}, ""});
                   }),
                   "cannot be searched"));
}

}  // namespace
}  // namespace atlasgauge
