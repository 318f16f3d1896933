#include "io/file/output_file.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "io/error.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

using Names = std::vector<std::string>;

std::string text_of(std::size_t bytes) {
  std::string text(bytes, '\0');
  for (std::size_t i = 0; i < bytes; ++i) text[i] = static_cast<char>('a' + i * i % 23);
  return text;
}

class OutputFileTest : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return (dir_.path() / name).string(); }

  /// The text of the error, which is the disk's fault and names the path.
  template <class Work>
  std::string resource_error(const std::string& path, Work work) const {
    try {
      work();
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kResource);
      EXPECT_TRUE(std::string(error.what()).starts_with(path)) << error.what();
      return error.what();
    }
    return "no error";
  }

  TempDir dir_;
};

TEST_F(OutputFileTest, PiecesOfAnySizeAddUp) {
  constexpr std::size_t kBuffer = OutputFile::kBufferBytes;
  OutputFile output(file("a"));
  std::string whole;
  for (const std::size_t bytes : {std::size_t{1}, kBuffer - 1, kBuffer, kBuffer + 1, std::size_t{0},
                                  3 * kBuffer, std::size_t{7}, kBuffer - 7, std::size_t{5}}) {
    const std::string piece = text_of(bytes);
    output.append(piece);
    whole += piece;
  }
  output.commit();
  EXPECT_EQ(content_of(file("a")), whole);
}

TEST_F(OutputFileTest, ByteByByteIsTheSame) {
  const std::string whole = text_of(2 * OutputFile::kBufferBytes + 3);
  OutputFile output(file("a"));
  for (const char c : whole) output.append({&c, 1});
  output.commit();
  EXPECT_EQ(content_of(file("a")), whole);
}

TEST_F(OutputFileTest, NothingAppendedIsAnEmptyFile) {
  OutputFile(file("a")).commit();
  EXPECT_EQ(content_of(file("a")), "");
  EXPECT_EQ(names_in(dir_.path()), Names{"a"});
}

TEST_F(OutputFileTest, NothingHasANameBeforeTheCommit) {
  OutputFile output(file("a"));
  output.append(text_of(3 * OutputFile::kBufferBytes));
  EXPECT_EQ(names_in(dir_.path()), Names{});
  output.commit();
  EXPECT_EQ(names_in(dir_.path()), Names{"a"});
}

TEST_F(OutputFileTest, WithoutCommitNothingIsLeft) {
  { OutputFile(file("a")).append(text_of(3 * OutputFile::kBufferBytes)); }
  EXPECT_EQ(names_in(dir_.path()), Names{});
}

TEST_F(OutputFileTest, WithoutCommitTheOldFileStays) {
  dir_.write("a", "old");
  { OutputFile(file("a")).append("new"); }
  EXPECT_EQ(content_of(file("a")), "old");
}

TEST_F(OutputFileTest, CommitReplacesTheOldFileAndKeepsItsPermissions) {
  dir_.write("a", "an old and longer one");
  fs::permissions(file("a"), fs::perms(0640));
  write_file(file("a"), "new");
  EXPECT_EQ(content_of(file("a")), "new");
  EXPECT_EQ(fs::status(file("a")).permissions(), fs::perms(0640));
  EXPECT_EQ(names_in(dir_.path()), Names{"a"});
}

TEST_F(OutputFileTest, NewFileHasThePermissionsOfTheUser) {
  const mode_t before = ::umask(0027);
  write_file(file("a"), "new");
  ::umask(before);
  EXPECT_EQ(fs::status(file("a")).permissions(), fs::perms(0640));
}

TEST_F(OutputFileTest, SymbolicLinkStays) {
  fs::create_directory(file("folder"));
  fs::create_symlink("folder/a", file("link"));
  write_file(file("link"), "text");
  EXPECT_TRUE(fs::is_symlink(file("link")));
  EXPECT_EQ(content_of(file("folder/a")), "text");
}

TEST_F(OutputFileTest, FullDeviceIsAnErrorWithItsName) {
  const std::string error = resource_error("/dev/full", [] { write_file("/dev/full", "text"); });
  EXPECT_NE(error.find("No space left on device"), std::string::npos) << error;
}

TEST_F(OutputFileTest, FullDeviceIsFeltWhenTheBufferIsFull) {
  OutputFile output("/dev/full");
  output.append(text_of(OutputFile::kBufferBytes - 1));
  resource_error("/dev/full", [&] { output.append("more"); });
}

TEST_F(OutputFileTest, FileThatMayGrowNoLargerIsAnErrorAndLeavesTheOldOne) {
  dir_.write("a", "old");
  {
    OutputFile output(file("a"));
    const FileSizeLimit limit(3 * OutputFile::kBufferBytes / 2);
    const std::string error = resource_error(file("a"), [&] {
      for (int i = 0; i < 3; ++i) output.append(text_of(OutputFile::kBufferBytes));
    });
    EXPECT_NE(error.find("File too large"), std::string::npos) << error;
  }
  EXPECT_EQ(content_of(file("a")), "old");
  EXPECT_EQ(names_in(dir_.path()), Names{"a"});
}

TEST_F(OutputFileTest, FolderThatIsGoneAtTheCommitIsAnError) {
  fs::create_directory(file("folder"));
  OutputFile output(file("folder/a"));
  fs::remove_all(file("folder"));
  resource_error(file("folder/a"), [&] { output.commit(); });
}

TEST_F(OutputFileTest, DirectoriesAndMissingFoldersAreRefusedAtOnce) {
  resource_error(dir_.path().string(), [&] { OutputFile output(dir_.path().string()); });
  resource_error(file("none/a"), [&] { OutputFile output(file("none/a")); });
}

TEST_F(OutputFileTest, DashIsStandardOutputAndNoFileOfAnyName) {
  const fs::path before = fs::current_path();
  fs::current_path(dir_.path());
  testing::internal::CaptureStdout();
  write_file("-", "text");
  write_file("standard output", "file");
  fs::current_path(before);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "text");
  EXPECT_EQ(content_of(file("standard output")), "file");
  EXPECT_EQ(names_in(dir_.path()), Names{"standard output"});
}

TEST_F(OutputFileTest, PipeIsWrittenDirectly) {
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  std::string read;
  std::jthread reader([&] { read = content_of(file("pipe")); });
  write_file(file("pipe"), text_of(3 * OutputFile::kBufferBytes));
  reader.join();
  EXPECT_EQ(read, text_of(3 * OutputFile::kBufferBytes));
}

class UnnamedFileTest : public OutputFileTest {};

TEST_F(UnnamedFileTest, PartsComeInAnyOrder) {
  UnnamedFile output(file("a"));
  output.write_at(70'000, "end");
  output.write_at(1, "bcd");
  output.write_at(0, "a");
  output.write_at(2, "C");
  output.commit();
  std::string wanted(70'003, '\0');
  wanted.replace(0, 4, "abCd").replace(70'000, 3, "end");
  EXPECT_EQ(content_of(file("a")), wanted);
}

TEST_F(UnnamedFileTest, PipesAndDevicesAreRefused) {
  ASSERT_EQ(::mkfifo(file("pipe").c_str(), 0600), 0);
  for (const std::string& path : {file("pipe"), std::string("/dev/full")}) {
    const std::string error = resource_error(path, [&] { UnnamedFile output(path); });
    EXPECT_NE(error.find("it is a pipe or a device"), std::string::npos) << error;
  }
}

TEST_F(UnnamedFileTest, WriteBeyondTheLargestFileIsAnError) {
  const UnnamedFile output(file("a"));
  const FileSizeLimit limit(1000);
  EXPECT_NE(resource_error(file("a"), [&] { output.write_at(999, "xy"); }).find("File too large"),
            std::string::npos);
}

/// These tests again, with system calls that fail or do little.
class OutputFileFaultsTest : public testing::TestWithParam<const char*> {};

TEST_P(OutputFileFaultsTest, AllHolds) {
  const ProgramResult result = run_program(
      "/proc/self/exe", {"--gtest_filter=OutputFileTest.*:UnnamedFileTest.*"},
      {std::string("LD_PRELOAD=") + ATLASGAUGE_FAULTY_IO, std::string("FAULTY_IO=") + GetParam(),
       "ASAN_OPTIONS=verify_asan_link_order=0"});
  EXPECT_EQ(result.exit_code, 0) << result.out << result.err;
  EXPECT_NE(result.out.find("PASSED  ] 19 tests"), std::string::npos) << result.out;
}

INSTANTIATE_TEST_SUITE_P(Faults, OutputFileFaultsTest,
                         testing::Values("unnamed:1+:EOPNOTSUPP", "linkat:1+:EPERM",
                                         "write:every2:EINTR pwrite:every2:EINTR",
                                         "write:1+:short9999 pwrite:1+:short1",
                                         "unnamed:1+:EOPNOTSUPP pread:every2:EINTR "
                                         "write:every3:short1000"));

}  // namespace
}  // namespace atlasgauge
