#include "io/file/byte_source.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <random>
#include <string>
#include <thread>

#include "io/error.hpp"
#include "tests/support/compressed.hpp"
#include "tests/support/obj_text.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

/// Text that compresses a little, of many blocks.
std::string noisy_text(std::size_t bytes) {
  std::mt19937 random(5);
  std::string text;
  while (text.size() < bytes) text += "v " + std::to_string(random()) + " 0 0\n";
  return text;
}

std::string read_all(const std::string& path, std::size_t bytes_a_read = 1 << 16) {
  const std::unique_ptr<ByteSource> source = open_byte_source(path);
  std::string text;
  std::string buffer(bytes_a_read, '\0');
  while (const std::size_t got = source->read(buffer.data(), buffer.size())) {
    text.append(buffer, 0, got);
  }
  EXPECT_EQ(source->read(buffer.data(), buffer.size()), 0U);
  return text;
}

std::string error_of(const std::string& path) {
  try {
    read_all(path);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    return error.what();
  }
  return "";
}

TEST(ByteSourceTest, PlainFilesAreReadWhole) {
  const TempDir dir;
  for (const std::size_t bytes : {0U, 1U, 3U, 4U, 5U, 1000U, 200000U}) {
    const std::string text = noisy_text(200000).substr(0, bytes);
    const std::string path = dir.write("plain", text);
    EXPECT_EQ(read_all(path), text);
    EXPECT_EQ(read_all(path, 3), text);
  }
}

TEST(ByteSourceTest, CompressedFilesEqualPlainOnes) {
  const TempDir dir;
  for (const std::size_t bytes : {0U, 1U, 1000U, 3000000U}) {
    const std::string text = noisy_text(3000000).substr(0, bytes);
    EXPECT_EQ(read_all(dir.write("a.gz", gzip(text))), text);
    EXPECT_EQ(read_all(dir.write("a.zst", zstd(text))), text);
  }
  const std::string text = noisy_text(10000);
  EXPECT_EQ(read_all(dir.write("a.gz", gzip(text)), 7), text);
  EXPECT_EQ(read_all(dir.write("a.zst", zstd(text)), 7), text);
}

TEST(ByteSourceTest, FilesOfSeveralMembersAreReadWhole) {
  const TempDir dir;
  const std::string a = noisy_text(500000);
  EXPECT_EQ(read_all(dir.write("a", gzip(a) + gzip("") + gzip("b") + gzip(a))), a + "b" + a);
  EXPECT_EQ(read_all(dir.write("a", zstd(a) + zstd("") + zstd("b") + zstd(a))), a + "b" + a);
  const std::string skippable("\x53\x2A\x4D\x18\x03\0\0\0abc", 11);
  EXPECT_EQ(read_all(dir.write("a", skippable + zstd("b") + skippable)), "b");
}

TEST(ByteSourceTest, CompressedFilesCutAnywhereAreErrors) {
  const TempDir dir;
  const std::string text = noisy_text(400);
  for (const std::string& whole : {gzip(text), zstd(text)}) {
    for (std::size_t bytes = 4; bytes < whole.size(); ++bytes) {
      const std::string path = dir.write("cut", whole.substr(0, bytes));
      const std::string error = error_of(path);
      // A compressor may end with an empty frame, which is no loss.
      if (error.empty())
        ASSERT_EQ(read_all(path), text);
      else
        ASSERT_NE(error.find("cut off or damaged"), std::string::npos) << bytes;
    }
  }
}

TEST(ByteSourceTest, ACutInALaterMemberIsAnError) {
  const TempDir dir;
  const std::string text = noisy_text(400);
  for (const std::string& member : {gzip(text), zstd(text)}) {
    for (std::size_t bytes = 1; bytes < member.size() - 20; ++bytes) {
      ASSERT_NE(error_of(dir.write("cut", member + member.substr(0, bytes))), "") << bytes;
    }
  }
}

TEST(ByteSourceTest, LargeZstdFilesCutAnywhereAreErrors) {
  const TempDir dir;
  const std::string whole = zstd(noisy_text(2000000));
  for (std::size_t bytes = 7; bytes < whole.size(); bytes += whole.size() / 50) {
    ASSERT_NE(error_of(dir.write("cut", whole.substr(0, bytes))), "") << bytes;
  }
}

TEST(ByteSourceTest, DamagedCompressedFilesNeverCrash) {
  const TempDir dir;
  std::mt19937 random(3);
  const std::string text = noisy_text(5000);
  for (const std::string& whole : {gzip(text), zstd(text)}) {
    for (int round = 0; round < 300; ++round) {
      std::string damaged = whole;
      damaged[4 + random() % (damaged.size() - 4)] ^= static_cast<char>(1 + random() % 255);
      error_of(dir.write("damaged", damaged));
    }
  }
}

TEST(ByteSourceTest, MissingFilesAndFoldersAreErrorsWithTheirReason) {
  const TempDir dir;
  EXPECT_NE(error_of((dir.path() / "none").string()).find("No such file"), std::string::npos);
  EXPECT_NE(error_of(dir.path().string()).find("directory"), std::string::npos);
}

TEST(ByteSourceTest, APipeIsReadLikeAFile) {
  const TempDir dir;
  const std::string path = (dir.path() / "pipe").string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  for (const std::string& content : {std::string("v 1 2 3\n"), gzip("v 1 2 3\n")}) {
    std::thread writer([&] { std::ofstream(path, std::ios::binary) << content; });
    EXPECT_EQ(read_all(path), "v 1 2 3\n");
    writer.join();
  }
}

TEST(ByteSourceTest, ProgressIsCountedInBytesOnDisk) {
  const TempDir dir;
  const std::string content = gzip(noisy_text(3000000));
  const std::unique_ptr<ByteSource> source = open_byte_source(dir.write("a.gz", content));
  EXPECT_EQ(source->file_bytes(), content.size());
  EXPECT_EQ(source->consumed_bytes(), 0U);
  std::string buffer(1 << 16, '\0');
  EXPECT_GT(source->read(buffer.data(), buffer.size()), 0U);
  EXPECT_LT(source->consumed_bytes(), content.size());
  while (source->read(buffer.data(), buffer.size()) != 0) continue;
  EXPECT_EQ(source->consumed_bytes(), content.size());
}

TEST(ByteSourceTest, AnObjIsTheSameCompressed) {
  const TempDir dir;
  const std::string text = noisy_text(300000) + "f 1 2 3 4\n";
  const std::unique_ptr<ByteSource> gzip_source = open_byte_source(dir.write("a.gz", gzip(text)));
  const std::unique_ptr<ByteSource> zstd_source = open_byte_source(dir.write("a.zst", zstd(text)));
  const ObjContent plain = read_obj(text);
  EXPECT_EQ(plain.mesh.faces.size(), 2U);
  for (ByteSource* const source : {gzip_source.get(), zstd_source.get()}) {
    const ObjContent obj = read_obj(*source);
    EXPECT_EQ(obj.mesh.positions.size(), plain.mesh.positions.size());
    EXPECT_EQ(obj.mesh.positions.back().x, plain.mesh.positions.back().x);
    EXPECT_EQ(obj.mesh.faces.size(), 2U);
  }
}

/// Reads a file of which `change` makes another once reading has begun.
template <class Change>
void expect_change_refused(const std::string& content, Change change) {
  const TempDir dir;
  const std::string path = dir.write("model", content);
  const std::unique_ptr<ByteSource> source = open_byte_source(path);
  std::string buffer(1000, '\0');
  source->read(buffer.data(), buffer.size());
  change(path);
  try {
    while (source->read(buffer.data(), buffer.size()) > 0) {
    }
    FAIL() << "no error";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_NE(std::string(error.what()).find("it changes while it is read"), std::string::npos)
        << error.what();
  }
}

TEST(ByteSourceTest, FileThatGrowsWhileItIsReadIsRefused) {
  const auto grow = [](const std::string& path) {
    std::ofstream(path, std::ios::app) << "v 1 2 3\n";
  };
  expect_change_refused(noisy_text(100'000), grow);
}

TEST(ByteSourceTest, FileThatShrinksWhileItIsReadIsRefused) {
  const auto shrink = [](const std::string& path) { std::filesystem::resize_file(path, 50'000); };
  expect_change_refused(noisy_text(100'000), shrink);
}

TEST(ByteSourceTest, FilesThatTellNoSizeAreRead) {
  EXPECT_NE(read_all("/proc/self/status").find("Pid"), std::string::npos);
}

}  // namespace
}  // namespace atlasgauge
