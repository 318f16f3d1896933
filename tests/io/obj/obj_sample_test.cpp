#include "io/obj/obj_sample.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <boost/iostreams/copy.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filtering_stream.hpp>
#include <sstream>
#include <string>

#include "io/error.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

/// Vertices, then texture coordinates, then faces: the usual order, in which no part of the text
/// is like the whole.
std::string strip_text(int quads) {
  std::ostringstream text;
  text << "mtllib a library.mtl\n";
  for (int i = 0; i <= quads; ++i) text << "v " << i << " 0 0.25\nv " << i << " 1 0.25\n";
  for (int i = 0; i <= quads; ++i) text << "vt 0." << i << " 0\n";
  for (int i = 0; i < quads; ++i) {
    const int a = 2 * i + 1;
    text << "f " << a << "/1 " << a + 2 << "/2 " << a + 3 << "/2 " << a + 1 << "/1\n";
  }
  return text.str();
}

struct Counts {
  double positions = 0, texcoords = 0, faces = 0;
  ObjSampling sampling;
};

Counts sample(const std::string& path, const ObjSampleSize& size = {}) {
  Counts counts;
  counts.sampling = sample_obj(
      path,
      [&](double weight, const MeshBatch& batch) {
        counts.positions += weight * static_cast<double>(batch.positions.size());
        counts.texcoords += weight * static_cast<double>(batch.texcoords.size());
        counts.faces += weight * static_cast<double>(batch.faces.size());
      },
      size);
  return counts;
}

TEST(ObjSampleTest, SmallFileIsCounted) {
  const TempDir dir;
  const Counts counts = sample(dir.write("strip.obj", strip_text(1000)));
  EXPECT_EQ(counts.sampling.coverage, ObjSampling::Coverage::kWhole);
  EXPECT_EQ(counts.positions, 2002);
  EXPECT_EQ(counts.texcoords, 1001);
  EXPECT_EQ(counts.faces, 2000);
}

TEST(ObjSampleTest, LargeFileIsSampledAllOver) {
  const TempDir dir;
  const std::string text = strip_text(50'000);
  const Counts counts = sample(dir.write("strip.obj", text), {256 << 10, 4 << 10});
  EXPECT_EQ(counts.sampling.coverage, ObjSampling::Coverage::kSpread);
  EXPECT_EQ(counts.sampling.text_bytes, static_cast<double>(text.size()));
  EXPECT_LE(counts.sampling.sampled_bytes, 256 << 10);
  EXPECT_NEAR(counts.positions, 100'002, 5'000);
  EXPECT_NEAR(counts.texcoords, 50'001, 2'500);
  EXPECT_NEAR(counts.faces, 100'000, 5'000);
}

TEST(ObjSampleTest, OfACompressedFileTheBeginningIsSeen) {
  const TempDir dir;
  std::istringstream in(strip_text(50'000));
  std::ostringstream out;
  boost::iostreams::filtering_istream filter;
  filter.push(boost::iostreams::gzip_compressor());
  filter.push(in);
  boost::iostreams::copy(filter, out);
  const Counts counts = sample(dir.write("strip.obj.gz", out.str()), {256 << 10, 4 << 10});
  EXPECT_EQ(counts.sampling.coverage, ObjSampling::Coverage::kBeginning);
  EXPECT_GT(counts.positions, 10'000);
  EXPECT_EQ(counts.faces, 0);
  EXPECT_GT(counts.sampling.text_bytes, 2 * counts.sampling.sampled_bytes);
}

TEST(ObjSampleTest, LibrariesAreNoted) {
  const TempDir dir;
  const Counts counts = sample(dir.write("strip.obj", strip_text(3)));
  EXPECT_EQ(counts.sampling.mtllib_lines, std::vector<std::string>{"a library.mtl"});
}

TEST(ObjSampleTest, NegativeIndicesKeepTheirDistances) {
  const TempDir dir;
  const std::string path =
      dir.write("relative.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf -3/-1 -2/-1 -1/-1\n");
  sample_obj(path, [&](double, const MeshBatch& batch) {
    ASSERT_EQ(batch.faces.size(), 1U);
    const FaceRecord& face = batch.faces[0];
    EXPECT_EQ(raw(face.v[1]) - raw(face.v[0]), 1U);
    EXPECT_EQ(raw(face.v[2]) - raw(face.v[1]), 1U);
    EXPECT_EQ(face.t[0], face.t[1]);
  });
}

TEST(ObjSampleTest, WhatCannotBeReadIsPassedOver) {
  const TempDir dir;
  const Counts counts = sample(dir.write("bad.obj", "v 0 0 0\nv 1 x 0\nv 0 0 0\n"));
  EXPECT_EQ(counts.positions, 1);
}

TEST(ObjSampleTest, LineLongerThanAPartCountsAsNothing) {
  const TempDir dir;
  std::string line = "f";
  for (int i = 0; i < 10'000; ++i) line += " 1";
  const Counts counts = sample(dir.write("line.obj", line), {16 << 10, 4 << 10});
  EXPECT_EQ(counts.faces, 0);
}

TEST(ObjSampleTest, EmptyFileIsWhole) {
  const TempDir dir;
  EXPECT_EQ(sample(dir.write("empty.obj", "")).sampling.coverage, ObjSampling::Coverage::kWhole);
}

TEST(ObjSampleTest, PipeIsRefusedUnread) {
  const TempDir dir;
  const std::string path = (dir.path() / "pipe").string();
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  EXPECT_THROW(sample(path), Error);
}

}  // namespace
}  // namespace atlasgauge
