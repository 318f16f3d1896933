#include "io/corpus/input_digest.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <xxhash.h>

#include <chrono>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/corpus/xxh3_hash.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

/// The digest of files in a folder.
InputDigest digest_in(const fs::path& root, const Names& names) {
  Names paths;
  for (const std::string& name : names) paths.push_back((root / name).string());
  return digest_inputs(root.string(), paths);
}

class InputDigestTest : public ::testing::Test {
 protected:
  InputDigest digest(const Names& names) const { return digest_in(dir_.path(), names); }

  /// Files have times of modification that no clock gives them.
  void write(const std::string& name, const std::string& content, int seconds = 0) const {
    const std::string path = dir_.write(name, content);
    fs::last_write_time(path, fs::file_time_type(std::chrono::seconds(seconds)));
  }

  std::string path(const std::string& name) const { return (dir_.path() / name).string(); }

  TempDir dir_;
};

TEST_F(InputDigestTest, IsTheHashOfNamesStatesSizesAndContents) {
  write("a.obj", "text");
  const auto number = [](char value) { return value + std::string(7, '\0'); };
  Xxh3Hash content;
  content.add("text");
  const auto bytes = content.bytes();
  const std::string expected =
      number(5) + "a.obj+" + number(4) + std::string(bytes.begin(), bytes.end());
  Xxh3Hash hash;
  hash.add(expected);
  EXPECT_EQ(digest({"a.obj"}).hex, hash.hex());
}

TEST_F(InputDigestTest, HashesAsTheLibraryDoesInOneGo) {
  const std::string text(1000, 'x');
  Xxh3Hash hash;
  hash.add(text.substr(0, 300));
  hash.add(text.substr(300));
  const XXH128_hash_t whole = XXH3_128bits(text.data(), text.size());
  XXH128_canonical_t canonical;
  XXH128_canonicalFromHash(&canonical, whole);
  const auto bytes = hash.bytes();
  EXPECT_TRUE(std::equal(bytes.begin(), bytes.end(), canonical.digest));
  EXPECT_EQ(hash.hex().size(), 32U);
}

TEST_F(InputDigestTest, NotesPathsSizesAndTimes) {
  write("a", "four", 7);
  write("b", "", 8);
  const InputDigest two = digest({"a", "b"});
  ASSERT_EQ(two.files.size(), 2U);
  EXPECT_EQ(two.bytes, 4U);
  EXPECT_EQ(two.files[0].path, path("a"));
  EXPECT_EQ(two.files[0].bytes, 4U);
  EXPECT_EQ(two.files[1].modified_ns - two.files[0].modified_ns, 1'000'000'000);
}

TEST_F(InputDigestTest, StaysWhereAllFilesMoveTogether) {
  write("here/model.obj", "model");
  write("here/maps/a.png", "image");
  const Names names{"model.obj", "maps/a.png", "none.mtl"};
  const std::string before = digest_in(dir_.path() / "here", names).hex;
  fs::rename(dir_.path() / "here", dir_.path() / "there");
  EXPECT_EQ(digest_in(dir_.path() / "there", names).hex, before);
}

TEST_F(InputDigestTest, StaysHoweverTheRootIsSpelled) {
  write("sub/a", "text");
  const std::string before = digest({"sub/a"}).hex;
  for (const char* const spelling : {"/", "/.", "/./", "/sub/..", "//"}) {
    EXPECT_EQ(digest_inputs(dir_.path().string() + spelling, {path("sub/a")}).hex, before);
  }
  EXPECT_EQ(digest_inputs(fs::relative(dir_.path()).string(), {path("sub/a")}).hex, before);
}

TEST_F(InputDigestTest, StaysHoweverAFileIsSpelled) {
  write("sub/a", "text");
  const std::string before = digest({"sub/a"}).hex;
  EXPECT_EQ(digest({"./sub//../sub/a"}).hex, before);
  EXPECT_EQ(digest_inputs(dir_.path().string(), {fs::relative(path("sub/a")).string()}).hex,
            before);
}

TEST_F(InputDigestTest, StaysWhereTheRootIsReachedThroughALink) {
  write("real/a", "text");
  fs::create_directory_symlink(dir_.path() / "real", dir_.path() / "link");
  const std::string before = digest_in(dir_.path() / "real", {"a"}).hex;
  EXPECT_EQ(digest_inputs(path("link"), {path("real/a")}).hex, before);
}

TEST_F(InputDigestTest, TakesTheWorkingFolderForAnEmptyRoot) {
  EXPECT_EQ(digest_inputs("", {"none"}).hex, digest_inputs(".", {"./none"}).hex);
}

TEST_F(InputDigestTest, KnowsFilesBesideTheRoot) {
  write("a", "text");
  fs::create_directory(dir_.path() / "root");
  EXPECT_EQ(digest_inputs(path("root"), {path("a")}).hex,
            digest_inputs(path("root"), {path("root/../a")}).hex);
  EXPECT_NE(digest_inputs(path("root"), {path("a")}).hex, digest({"a"}).hex);
}

TEST_F(InputDigestTest, ChangesWithTheNameOfAFile) {
  write("a", "text");
  const std::string before = digest({"a"}).hex;
  fs::rename(path("a"), path("b"));
  EXPECT_NE(digest({"b"}).hex, before);
}

TEST_F(InputDigestTest, ChangesWhereTwoFilesSwapTheirContents) {
  write("a", "one");
  write("b", "two");
  const std::string before = digest({"a", "b"}).hex;
  write("a", "two");
  write("b", "one");
  EXPECT_NE(digest({"a", "b"}).hex, before);
}

TEST_F(InputDigestTest, ChangesWithTheOrderOfTheFiles) {
  write("a", "text");
  write("b", "text");
  EXPECT_NE(digest({"a", "b"}).hex, digest({"b", "a"}).hex);
}

TEST_F(InputDigestTest, ChangesWithAByteOfContentWhateverTheTime) {
  write("a", "text");
  const std::string before = digest({"a"}).hex;
  write("a", "tent");
  EXPECT_NE(digest({"a"}).hex, before);
}

TEST_F(InputDigestTest, StaysWhereOnlyTheTimeChanges) {
  write("a", "text", 1);
  const std::string before = digest({"a"}).hex;
  write("a", "text", 2);
  EXPECT_EQ(digest({"a"}).hex, before);
}

TEST_F(InputDigestTest, ChangesWithTheLastByteOfAFileLargerThanABuffer) {
  std::string content(std::size_t{5} << 19, 'x');
  write("a", content);
  const InputDigest before = digest({"a"});
  content.back() = 'y';
  write("a", content);
  EXPECT_EQ(before.bytes, content.size());
  EXPECT_NE(digest({"a"}).hex, before.hex);
}

TEST_F(InputDigestTest, TellsAMissingFileFromAnEmptyOne) {
  const InputDigest missing = digest({"a"});
  write("a", "");
  EXPECT_NE(digest({"a"}).hex, missing.hex);
  EXPECT_EQ(missing.files[0], (InputFile{path("a"), 0, InputFile::kMissing}));
}

TEST_F(InputDigestTest, TakesAPipeOrAFolderForMissing) {
  const std::string missing = digest({"a"}).hex;
  ASSERT_EQ(::mkfifo(path("a").c_str(), 0600), 0);
  EXPECT_EQ(digest({"a"}).hex, missing);
  fs::remove(path("a"));
  fs::create_directory(path("a"));
  EXPECT_EQ(digest({"a"}).hex, missing);
}

TEST_F(InputDigestTest, FilesLeftAloneAreUnchanged) {
  write("a", "text");
  EXPECT_TRUE(unchanged(digest({"a", "none"}).files));
}

TEST_F(InputDigestTest, AFileOfAnotherSizeIsChanged) {
  write("a", "text");
  const InputDigest before = digest({"a"});
  write("a", "texts");
  EXPECT_FALSE(unchanged(before.files));
}

TEST_F(InputDigestTest, AFileOfAnotherTimeIsChanged) {
  write("a", "text", 1);
  const InputDigest before = digest({"a"});
  write("a", "text", 2);
  EXPECT_FALSE(unchanged(before.files));
}

TEST_F(InputDigestTest, AFileThatAppearsIsAChange) {
  const InputDigest before = digest({"a"});
  write("a", "");
  EXPECT_FALSE(unchanged(before.files));
}

TEST_F(InputDigestTest, AFileThatGoesIsAChange) {
  write("a", "");
  const InputDigest before = digest({"a"});
  fs::remove(path("a"));
  EXPECT_FALSE(unchanged(before.files));
}

TEST_F(InputDigestTest, OneChangeAmongManyFilesIsFound) {
  write("a", "text", 1);
  write("b", "text", 1);
  const InputDigest before = digest({"a", "b"});
  write("b", "text", 2);
  EXPECT_FALSE(unchanged(before.files));
}

}  // namespace
}  // namespace atlasgauge
