#include "io/file/byte_range.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

#include "tests/support/input_error.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

TEST(ByteRangeTest, PartsOfPartsCountFromTheirBegin) {
  const TempDir dir;
  for (const ByteRange& whole :
       {whole_file(dir.write("a", "0123456789")), bytes_in_memory("0123456789", "a")}) {
    EXPECT_EQ(read_range(whole), "0123456789");
    EXPECT_EQ(read_range(whole.part(2, 6).part(1, 3)), "345");
    EXPECT_EQ(read_begin(whole.part(8, 2), 5), "89");
    EXPECT_EQ(read_range(whole.part(10, 0)), "");
  }
}

TEST(ByteRangeTest, HoldsDoesNotOverflow) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  const ByteRange range = bytes_in_memory("0123456789", "a");
  EXPECT_TRUE(range.holds(10, 0));
  EXPECT_TRUE(range.holds(4, 6));
  EXPECT_FALSE(range.holds(4, 7));
  EXPECT_FALSE(range.holds(11, 0));
  EXPECT_FALSE(range.holds(1, kMost));
  EXPECT_FALSE(range.holds(kMost, 1));
}

TEST(ByteRangeTest, WhatIsNoFileIsAnError) {
  const TempDir dir;
  EXPECT_TRUE(says(input_error_of([&] { whole_file((dir.path() / "missing").string()); }),
                   "missing: cannot open: No such file"));
  EXPECT_TRUE(says(input_error_of([&] { whole_file(dir.path().string()); }), "found a folder"));
  EXPECT_TRUE(says(input_error_of([] { whole_file("/dev/zero"); }), "regular file is expected"));
}

TEST(ByteRangeTest, AFileThatBecameShorterIsAnError) {
  const TempDir dir;
  const std::string path = dir.write("a", "0123456789");
  const ByteRange range = whole_file(path);
  std::filesystem::resize_file(path, 5);
  EXPECT_EQ(read_range(range.part(0, 5)), "01234");
  EXPECT_TRUE(says(input_error_of([&] { read_range(range); }), "it has become shorter"));
}

TEST(ByteRangeTest, BytesBeyondTheRangeAreNotRead) {
  const RangeReader reader(bytes_in_memory("0123456789", "a").part(2, 3));
  char byte = 0;
  reader.read(2, &byte, 1);
  EXPECT_EQ(byte, '4');
  EXPECT_TRUE(says(input_error_of([&] { reader.read(3, &byte, 1); }), "found 3 bytes where"));
}

}  // namespace
}  // namespace atlasgauge
