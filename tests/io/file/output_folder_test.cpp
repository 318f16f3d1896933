#include "io/file/output_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "io/error.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

class OutputFolderTest : public testing::Test {
 protected:
  std::string error_of(const std::string& path) {
    try {
      make_output_folder(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kResource);
      EXPECT_TRUE(std::string(error.what()).starts_with(path)) << error.what();
      return error.what();
    }
    return "";
  }

  TempDir dir_;
  const std::string folder_ = (dir_.path() / "maps").string();
};

TEST_F(OutputFolderTest, IsMadeAndMayBeThere) {
  make_output_folder(folder_);
  EXPECT_TRUE(fs::is_directory(folder_));
  make_output_folder(folder_);
  make_output_folder(folder_ + "/");
}

TEST_F(OutputFolderTest, LinkToAFolderIsOne) {
  fs::create_symlink(".", dir_.path() / "link");
  EXPECT_EQ(error_of((dir_.path() / "link").string()), "");
}

TEST_F(OutputFolderTest, FolderInNoFolderIsRefused) {
  EXPECT_NE(error_of(folder_ + "/deep").find("does not exist"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_));
  EXPECT_NE(error_of(""), "");
}

TEST_F(OutputFolderTest, FileInItsPlaceIsRefused) {
  dir_.write("maps", "a file");
  EXPECT_NE(error_of(folder_).find("something else than a folder"), std::string::npos);
  EXPECT_NE(error_of(folder_ + "/deep").find("Not a directory"), std::string::npos);
}

TEST_F(OutputFolderTest, LinkToNothingIsRefused) {
  fs::create_symlink("nothing", folder_);
  EXPECT_NE(error_of(folder_), "");
}

TEST_F(OutputFolderTest, FolderThatTakesNoFoldersIsRefused) {
  EXPECT_NE(error_of("/proc/maps"), "");
}

TEST_F(OutputFolderTest, FolderThatTakesNoFilesIsRefused) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::create_directory(folder_);
  fs::permissions(folder_, fs::perms(0555));
  EXPECT_NE(error_of(folder_).find("Permission denied"), std::string::npos);
}

}  // namespace
}  // namespace atlasgauge
