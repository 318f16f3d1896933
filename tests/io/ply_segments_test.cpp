#include "io/ply_segments.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>

#include "io/error.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

constexpr const char* kHeaderOfTwo =
    "ply\n"
    "format binary_little_endian 1.0\n"
    "element vertex 4\n"
    "property double x\n"
    "property double y\n"
    "property double z\n"
    "property uchar red\n"
    "property uchar green\n"
    "property uchar blue\n"
    "property double error\n"
    "element edge 2\n"
    "property int vertex1\n"
    "property int vertex2\n"
    "property uchar red\n"
    "property uchar green\n"
    "property uchar blue\n"
    "end_header\n";

/// Takes a file apart, byte by byte.
class Bytes {
 public:
  explicit Bytes(std::string bytes) : bytes_(std::move(bytes)) {}

  bool starts_with(const std::string& text) {
    at_ += text.size();
    return bytes_.starts_with(text);
  }
  std::uint64_t little(int bytes) {
    std::uint64_t value = 0;
    for (int i = 0; i < bytes; ++i) {
      value |= std::uint64_t{static_cast<std::uint8_t>(bytes_.at(at_++))} << (8 * i);
    }
    return value;
  }
  double number() { return std::bit_cast<double>(little(8)); }
  bool at_end() const { return at_ == bytes_.size(); }

 private:
  std::string bytes_;
  std::size_t at_ = 0;
};

class PlySegmentsTest : public testing::Test {
 protected:
  std::string path() const { return (dir_.path() / "a.ply").string(); }

  TempDir dir_;
};

const Segment kRedOne{{{1, 2, 3}, {4, 5, 6.25}}, {255, 0, 1}, 0.5};
const Segment kGreyOne{{{-1e300, 0, 0.1}, {7, 8, 9}}, {128, 129, 130}, -1};

TEST_F(PlySegmentsTest, HoldsVerticesThenEdges) {
  PlySegments ply(path(), "error");
  ply.begin(2);
  for (const Segment& segment : {kRedOne, kGreyOne}) ply.add_ends(segment);
  for (const Segment& segment : {kRedOne, kGreyOne}) ply.add_edge(segment.color);
  ply.commit();
  Bytes bytes(content_of(path()));
  ASSERT_TRUE(bytes.starts_with(kHeaderOfTwo)) << content_of(path());
  for (const Segment& segment : {kRedOne, kGreyOne}) {
    for (const Position& end : segment.ends) {
      EXPECT_EQ(bytes.number(), end.x);
      EXPECT_EQ(bytes.number(), end.y);
      EXPECT_EQ(bytes.number(), end.z);
      EXPECT_EQ(bytes.little(1), segment.color.red);
      EXPECT_EQ(bytes.little(1), segment.color.green);
      EXPECT_EQ(bytes.little(1), segment.color.blue);
      EXPECT_EQ(bytes.number(), segment.value);
    }
  }
  std::uint64_t vertex = 0;
  for (const Segment& segment : {kRedOne, kGreyOne}) {
    EXPECT_EQ(bytes.little(4), vertex++);
    EXPECT_EQ(bytes.little(4), vertex++);
    EXPECT_EQ(bytes.little(1), segment.color.red);
    EXPECT_EQ(bytes.little(1), segment.color.green);
    EXPECT_EQ(bytes.little(1), segment.color.blue);
  }
  EXPECT_TRUE(bytes.at_end());
}

TEST_F(PlySegmentsTest, NoSegmentsAreAFileToo) {
  PlySegments ply(path(), "error");
  ply.begin(0);
  ply.commit();
  const std::string content = content_of(path());
  EXPECT_NE(content.find("element vertex 0\n"), std::string::npos);
  EXPECT_NE(content.find("element edge 0\n"), std::string::npos);
  EXPECT_TRUE(content.ends_with("end_header\n"));
}

TEST_F(PlySegmentsTest, SegmentsThatWereAnnouncedAndDidNotComeAreAnError) {
  PlySegments never_begun(path(), "error");
  EXPECT_THROW(never_begun.commit(), Error);
  PlySegments without_edges(path(), "error");
  without_edges.begin(1);
  without_edges.add_ends(kRedOne);
  EXPECT_THROW(without_edges.commit(), Error);
  PlySegments without_ends(path(), "error");
  without_ends.begin(1);
  without_ends.add_edge(kRedOne.color);
  EXPECT_THROW(without_ends.commit(), Error);
  EXPECT_FALSE(std::filesystem::exists(path()));
}

TEST_F(PlySegmentsTest, WithoutACommitNothingIsLeft) {
  {
    PlySegments ply(path(), "error");
    ply.begin(1);
    ply.add_ends(kRedOne);
  }
  EXPECT_TRUE(names_in(dir_.path()).empty());
}

}  // namespace
}  // namespace atlasgauge
