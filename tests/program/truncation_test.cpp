#include <gtest/gtest.h>

#include <boost/crc.hpp>
#include <boost/endian/buffers.hpp>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "io/error.hpp"
#include "io/image/image_reader.hpp"
#include "tests/support/compressed.hpp"
#include "tests/support/oracle_comparison.hpp"
#include "tests/support/temp_dir.hpp"

// Files cut at any byte, and files that are no models at all: each ends in a report that the oracle
// confirms, or in an input error that names the place.
namespace atlasgauge {
namespace {

const std::string kObj =
    "# every feature, in few bytes \\\r\nthis line is comment, too\r\n"
    "mtllib  model.mtl\n"
    "v 0 0 0\r\nv 1 0 0 1.0\nv 1 1 0 # up\nv -0 1.5e0 +0\n"
    "vt 0 0\nvt 1\nvt 1 1 0\nvt .25 1e-1\n"
    "usemtl second one\nf 1/1/1 2/2 3/3//1\nf -4/-4 -2/-2 -1/-1\n"
    "v nan 0 0\nv 1.#INF -inf 1.#QNAN\nvt -nan 0\n"
    "usemtl\tfirst\r\nf 1 2 \\\n 5\nf 6//1 2//1 3//1\nf 3/5 2/2 1/0\n"
    "o thing\ng a b\ns off\nvn 0 0 1\nl 1 2\np 1\nodd statement\n"
    "f 1/6 7/6 8/99 9/-1 3/3\nf 1 2 99999999999999999999\nf 0 1 2\nf 1 2\n"
    "v 2 0 0\nv 2 1 \\\r\n 0\nv 2 0 0\nvt 2 2\n"
    "usemtl nowhere\nf 7/6 8/6 8/6 2/2\n"
    "usemtl third\nf 2/2 7/1 8/3 3/4\nf 2/2 7/1 8/3 3/4";

const std::string kMtl =
    "# materials\r\nnewmtl first\nKd 1 1 1\nmap_Ka no.png\n"
    "map_Kd -s 1 1 1 -o 0.5 0 -bm 1 a.png\r\n"
    "newmtl second one\n\tmap_Kd b two.png # a comment\n"
    "newmtl first\nmap_Kd c.png\n"
    "newmtl third\nmap_Kd missing.png\nmap_Kd .\\c.png";

const ImageSizes kImages = {{"a.png", {64, 32}}, {"b two.png", {33, 8}}, {"c.png", {1, 1}}};

class TruncationTest : public ::testing::Test {
 protected:
  void SetUp() override {
    for (const auto& image : kImages) dir_.write(image.first, "");
    dir_.write("model.mtl", kMtl);
    config_.engine_bytes = 4 << 20;
    config_.resident_bytes = 1 << 20;
    config_.probe = probe_of(kImages);
  }

  void expect_oracle_confirms(const std::string& model) {
    const Outcome outcome = pipeline_outcome(model, config_);
    for (const std::string& text : contradictions(outcome, oracle_outcome(model, config_))) {
      ADD_FAILURE() << text;
    }
    if (outcome.report) return;
    EXPECT_TRUE(outcome.refusal.starts_with(model + ":")) << outcome.refusal;
    const bool is_of_all_lines = outcome.refusal.find("no statement") != std::string::npos;
    EXPECT_EQ(outcome.refused_line == 0, is_of_all_lines) << outcome.refusal;
    ++refusals_;
  }

  /// The text of the error that a file must end in; it names the file.
  std::string refusal_of(const std::string& name, std::string_view content) {
    const std::string model = dir_.write(name, content);
    const Outcome outcome = pipeline_outcome(model, config_);
    EXPECT_FALSE(outcome.report) << "there is a report";
    EXPECT_TRUE(outcome.refusal.starts_with(model + ":")) << outcome.refusal;
    return outcome.refusal;
  }

  TempDir dir_;
  PipelineConfig config_;
  int refusals_ = 0;
};

TEST_F(TruncationTest, AnObjCutAtAnyByteIsMeasuredOrRefusedWithItsLine) {
  for (std::size_t bytes = 0; bytes <= kObj.size(); ++bytes) {
    SCOPED_TRACE("cut to " + std::to_string(bytes) + " bytes");
    expect_oracle_confirms(dir_.write("model.obj", kObj.substr(0, bytes)));
    if (HasFailure()) return;
  }
  // Within coordinates and numbers.
  EXPECT_GT(refusals_, 50);
}

TEST_F(TruncationTest, AnMtlCutAtAnyByteIsRead) {
  const std::string model = dir_.write("model.obj", kObj);
  for (std::size_t bytes = 0; bytes <= kMtl.size(); ++bytes) {
    SCOPED_TRACE("cut to " + std::to_string(bytes) + " bytes");
    dir_.write("model.mtl", kMtl.substr(0, bytes));
    expect_oracle_confirms(model);
    if (HasFailure()) return;
  }
  EXPECT_EQ(refusals_, 0);
}

TEST_F(TruncationTest, AGzippedObjCutAtAnyByteIsRefused) {
  const std::string whole = gzip(kObj);
  // Of one byte nothing tells that it was compressed: it is refused as text.
  for (std::size_t bytes = 2; bytes < whole.size(); ++bytes) {
    const std::string text = refusal_of("model.obj.gz", whole.substr(0, bytes));
    ASSERT_NE(text.find("cut off or damaged"), std::string::npos) << bytes << ": " << text;
  }
}

TEST_F(TruncationTest, AnObjInAZstdFrameCutAtAnyByteIsRefused) {
  const std::string whole = zstd(kObj);
  constexpr std::size_t kMagicBytes = 4;
  // The compressor ends with an empty frame.
  const std::size_t frame_bytes = whole.rfind(whole.substr(0, kMagicBytes));
  ASSERT_GT(frame_bytes, kObj.size() / 3);
  for (std::size_t bytes = kMagicBytes; bytes < frame_bytes; ++bytes) {
    const std::string text = refusal_of("model.obj.zst", whole.substr(0, bytes));
    ASSERT_NE(text.find("cut off or damaged"), std::string::npos) << bytes << ": " << text;
  }
}

TEST_F(TruncationTest, AnEmptyFileIsRefused) {
  EXPECT_NE(refusal_of("model.obj", "").find("no statement"), std::string::npos);
  expect_oracle_confirms(dir_.write("model.obj", ""));
}

TEST_F(TruncationTest, ZeroBytesAreRefusedAsBinary) {
  for (const std::size_t bytes : {1, 63, 5000, 300000}) {
    const std::string text = refusal_of("model.obj", std::string(bytes, '\0'));
    EXPECT_NE(text.find("model.obj:1: found zero bytes"), std::string::npos) << text;
  }
}

TEST_F(TruncationTest, BinaryFilesAreRefused) {
  std::string bytes;
  for (int i = 0; i < 5000; ++i) bytes += static_cast<char>(i * i * 37 >> 3 & 0xFF);
  EXPECT_NE(refusal_of("model.obj", bytes).find("zero bytes"), std::string::npos);
}

std::string big_endian(std::size_t value) {
  const boost::endian::big_uint32_buf_t bytes(static_cast<std::uint32_t>(value));
  return {reinterpret_cast<const char*>(bytes.data()), sizeof(bytes)};
}

std::string png_chunk(const std::string& type, const std::string& content) {
  boost::crc_32_type crc;
  crc.process_bytes((type + content).data(), type.size() + content.size());
  return big_endian(content.size()) + type + content + big_endian(crc.checksum());
}

constexpr std::size_t kPngHeaderBytes = 33;

/// Pixels for 2x2 texels of RGB, under a header of any size.
std::string png(std::size_t width, std::size_t height) {
  constexpr std::string_view kPixels(
      "\x78\xda\x63\x60\x64\x0a\xe0\xe4\x60\x67\x60\x66\x01\x51\x00\x06\x15\x00\xdb", 19);
  return std::string("\x89PNG\r\n\x1a\n") +
         png_chunk("IHDR",
                   big_endian(width) + big_endian(height) + std::string("\x08\x02\0\0\0", 5)) +
         png_chunk("IDAT", std::string(kPixels)) + png_chunk("IEND", "");
}

class ImageTruncationTest : public TruncationTest {
 protected:
  void SetUp() override {
    TruncationTest::SetUp();
    const auto folder = std::filesystem::path(ATLASGAUGE_PROGRAM).parent_path();
    ASSERT_EQ(::setenv("ATLASGAUGE_MODULE_DIR", folder.c_str(), 1), 0);
    config_.engine_bytes = std::uint64_t{64} << 20;  // of which decoders take some
    config_.probe = read_image_header;
    config_.open_image = open_image;
    dir_.write("model.mtl", "newmtl first\nmap_Kd a.png\n");
    model_ = dir_.write("model.obj",
                        "mtllib model.mtl\nusemtl first\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                        "vt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n");
  }

  nlohmann::json report_with_image(const std::string& image) {
    dir_.write("a.png", image);
    expect_oracle_confirms(model_);
    return pipeline_outcome(model_, config_).report.value();
  }

  std::string model_;
};

TEST_F(ImageTruncationTest, AnImageCutInItsHeaderHasNoSize) {
  const std::string whole = png(2, 2);
  for (std::size_t bytes = 0; bytes < kPngHeaderBytes; ++bytes) {
    EXPECT_EQ(report_with_image(whole.substr(0, bytes))["faces_untextured"], 1) << bytes;
  }
}

TEST_F(ImageTruncationTest, AnImageCutAtAnyByteHasItsSizeOrNone) {
  const std::string whole = png(2, 2);
  for (std::size_t bytes = kPngHeaderBytes; bytes <= whole.size(); ++bytes) {
    const nlohmann::json report = report_with_image(whole.substr(0, bytes));
    EXPECT_EQ(report["area_uv"], report["faces_untextured"] == 1 ? 0.0 : 2.0) << bytes;
  }
  EXPECT_EQ(report_with_image(whole)["area_uv"], 2.0);
}

TEST_F(ImageTruncationTest, AnImageIsAsLargeAsItsHeaderSays) {
  EXPECT_EQ(report_with_image(png(30000, 20000))["area_uv"], 3e8);
  EXPECT_EQ(report_with_image(png(0, 2))["faces_untextured"], 1);
  EXPECT_EQ(report_with_image(png(0xFFFFFFFF, 0xFFFFFFFF))["faces_untextured"], 1);
}

}  // namespace
}  // namespace atlasgauge
