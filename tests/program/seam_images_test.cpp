// Seam colours of images that are broken, hostile or too large, as files.

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "tests/support/child.hpp"
#include "tests/support/folder.hpp"
#include "tests/support/image_files.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kOld = "old report\n";
constexpr uid_t kNobody = 65534;

std::string constant_ppm(const Rgb8& colour) {
  return ppm_file(8, 8, [&](std::uint32_t, std::uint32_t) { return colour; });
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; ++at) ++count;
  return count;
}

/// Three unit quads in a row, each with an image of its own. The first two have constant colours 2,
/// 3 and 6 apart, so that the seam between them is 7 high; that of the third is up to the test.
class SeamImagesTest : public testing::Test {
 protected:
  SeamImagesTest() {
    fs::permissions(dir_.path(), fs::perms(0777));  // others than root get there
    dir_.write("a.ppm", constant_ppm({10, 20, 30}));
    dir_.write("b.ppm", constant_ppm({12, 23, 36}));
    write_model("third");
  }

  std::string file(const std::string& name) const { return (dir_.path() / name).string(); }

  /// The quads cover the middle of their images.
  void write_model(const std::string& third) const { write_model(third, "0.75"); }

  /// Of tiny parts of the images: they may be of any size, and little is to be drawn.
  void write_model_of_tiny_parts(const std::string& third) const { write_model(third, "0.2501"); }

  ProgramResult measure(const std::vector<std::string>& more = {}) const {
    std::vector<std::string> arguments{file("model.obj"), "--json", file("report.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_program(ATLASGAUGE_PROGRAM, arguments);
  }

  json report() const { return json::parse(content_of(file("report.json"))); }

  json good_report() const {
    write_model("a2.ppm");
    dir_.write("a2.ppm", constant_ppm({10, 20, 30}));
    EXPECT_EQ(measure({"-q"}).exit_code, 0);
    return report();
  }

  void expect_refused_before_work(const ProgramResult& result, const std::string& image) const {
    EXPECT_EQ(result.exit_code, 4) << result.err;
    EXPECT_NE(result.err.find(file(image)), std::string::npos) << result.err;
    EXPECT_EQ(count_of(result.err, "\n"), 1U) << result.err;
    EXPECT_EQ(content_of(file("report.json")), kOld);
    if (!ATLASGAUGE_SANITIZED) {
      EXPECT_LT(result.peak_resident_kib, 200 << 10) << "nothing decoded";
    }
  }

  TempDir dir_;

 private:
  /// UVs from 1/4 to `end`.
  void write_model(const std::string& third, const std::string& end) const {
    std::string obj = "mtllib model.mtl\n";
    for (const char* x : {"0", "1", "2", "3"}) {
      obj += std::string("v ") + x + " 0 0\nv " + x + " 1 0\n";
    }
    obj += "vt 0.25 0.25\nvt " + end + " 0.25\nvt " + end + " " + end + "\nvt 0.25 " + end + "\n";
    obj += "usemtl a\nf 1/1 3/2 4/3 2/4\nusemtl b\nf 3/1 5/2 6/3 4/4\n";
    obj += "usemtl c\nf 5/1 7/2 8/3 6/4\n";
    dir_.write("model.obj", obj);
    dir_.write("model.mtl",
               "newmtl a\nmap_Kd a.ppm\nnewmtl b\nmap_Kd b.ppm\nnewmtl c\nmap_Kd " + third + "\n");
  }
};

std::set<std::string> keys_of(const json& report) {
  std::set<std::string> keys;
  for (const auto& item : report.items()) keys.insert(item.key());
  return keys;
}

// Images that cannot be read.

/// Makes a bad image of this name.
struct BadImage {
  std::string test, name;
  std::function<void(const TempDir&, const std::string& name)> make;
};

void PrintTo(const BadImage& image, std::ostream* to) {
  *to << image.name;
}

/// A good one of 60 x 50 texels, cut short.
std::string cut_ppm() {
  return ppm_file(60, 50, [](std::uint32_t, std::uint32_t) { return Rgb8{}; }).substr(0, 5000);
}

std::vector<BadImage> bad_images() {
  const auto with = [](const std::string& content) {
    return [content](const TempDir& dir, const std::string& name) { dir.write(name, content); };
  };
  return {
      {"Missing", "none.png", [](const TempDir&, const std::string&) {}},
      {"Empty", "empty.png", with("")},
      {"Truncated", "cut.ppm", with(cut_ppm())},
      {"TruncatedTga", "cut.tga", with(tga_header(60, 50) + std::string(8000, 'x'))},
      {"TruncatedBeforeItsHeaderEnds", "cut.png", with(png_file(60, 50, false, "").substr(0, 20))},
      {"WithoutTexels", "hollow.png", with(png_file(60, 50, false, "no deflate"))},
      {"TruncatedJpeg", "cut.jpg", with(progressive_jpeg_head(60, 50))},
      {"Text", "text.png", with("this is no image\nbut two lines of text\n")},
      {"Directory", "folder.png",
       [](const TempDir& dir, const std::string& name) {
         fs::create_directory(dir.path() / name);
       }},
  };
}

class BadSeamImageTest : public SeamImagesTest, public testing::WithParamInterface<BadImage> {
 protected:
  void SetUp() override {
    good_ = good_report();
    write_model(GetParam().name);
    GetParam().make(dir_, GetParam().name);
    fs::remove(file("report.json"));
  }
  json good_;
};

TEST_P(BadSeamImageTest, IsAWarningThatNamesIt) {
  const ProgramResult result = measure({"-t", "16x16"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(count_of(result.err, "warning: "), 1U) << result.err;
  const std::size_t at = result.err.find("warning: ");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(count_of(result.err.substr(at), "\n"), 2U)
      << "a message is one line, and one has the counts: " << result.err;
  EXPECT_NE(result.err.find(GetParam().name, at), std::string::npos) << result.err;
}

TEST_P(BadSeamImageTest, LeavesItsSeamsUnsampledAndTheOthersMeasured) {
  ASSERT_EQ(measure({"-t", "16x16", "-q", "--texmetro-seams"}).exit_code, 0);
  const json got = report();
  EXPECT_EQ(got.at("seam_edges"), 2);
  EXPECT_EQ(got.at("seam_edges_unsampled"), 1);
  EXPECT_EQ(got.at("seam_discrepancy_min"), 7.0);
  EXPECT_EQ(got.at("seam_discrepancy_max"), 7.0);
  EXPECT_EQ(got.at("seam_discrepancy_avg"), 7.0);
  EXPECT_EQ(got.at("seam_discrepancy_texmetro_avg"), 7.0);
  EXPECT_EQ(got.at("seam_discrepancy_by_texture"), json({7.0, 7.0, nullptr}));
  EXPECT_EQ(got.at("worst_seams").size(), 1U);
}

TEST_P(BadSeamImageTest, LeavesTheReportComplete) {
  ASSERT_EQ(measure({"-t", "16x16", "-q"}).exit_code, 0);
  EXPECT_EQ(keys_of(report()), keys_of(good_));
  ASSERT_EQ(measure({"-q"}).exit_code, 0);
  EXPECT_EQ(keys_of(report()), keys_of(good_)) << "without a size for it";
  EXPECT_EQ(report().at("seam_discrepancy_avg"), 7.0);
}

TEST_P(BadSeamImageTest, IsAnErrorIfWarningsAre) {
  for (const bool sized : {false, true}) {
    std::vector<std::string> arguments{"--strict"};
    if (sized) arguments.insert(arguments.end(), {"-t", "16x16"});
    fs::remove(file("report.json"));
    const ProgramResult result = measure(arguments);
    EXPECT_EQ(result.exit_code, 3) << result.err;
    EXPECT_NE(result.err.find(GetParam().name), std::string::npos) << result.err;
    EXPECT_FALSE(fs::exists(file("report.json")));
    dir_.write("report.json", kOld);
    EXPECT_EQ(measure(arguments).exit_code, 3);
    EXPECT_EQ(content_of(file("report.json")), kOld);
  }
}

INSTANTIATE_TEST_SUITE_P(All, BadSeamImageTest, testing::ValuesIn(bad_images()),
                         [](const auto& instance) { return instance.param.test; });

TEST_F(SeamImagesTest, ImageThatMayNotBeReadIsAWarning) {
  write_model("secret.ppm");
  fs::permissions(dir_.write("secret.ppm", constant_ppm({0, 0, 0})), fs::perms::none);
  ChildSetup child;
  child.program = ATLASGAUGE_PROGRAM;
  child.arguments = {"--help"};
  if (::geteuid() == 0) child.user = kNobody;
  if (Child(child).wait().exit_code != 0) GTEST_SKIP() << "others cannot run the program";
  child.arguments = {file("model.obj"), "--json", file("report.json"), "-t", "16x16"};
  const ProgramResult result = Child(child).wait();
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("secret.ppm"), std::string::npos) << result.err;
  ASSERT_TRUE(fs::exists(file("report.json")));
  EXPECT_EQ(report().at("seam_edges_unsampled"), 1);
  EXPECT_EQ(report().at("seam_discrepancy_avg"), 7.0);
}

TEST_F(SeamImagesTest, RealImagesThatAreCutShortNeverHurtTheOthers) {
  const fs::path models = "/usr/share/assimp/models";
  int tried = 0;
  for (const char* name : {"OBJ/SpiderTex.jpg", "X/updown.tga", "MD2/faerie2.bmp", "3DS/test.png",
                           "LWO/LWO2/uvtest.png"}) {
    if (!fs::exists(models / name)) continue;
    const std::string bytes = content_of(models / name);
    const std::string copy = "copy" + fs::path(name).extension().string();
    write_model(copy);
    for (const std::size_t cut : {bytes.size(), bytes.size() * 9 / 10, bytes.size() / 2}) {
      SCOPED_TRACE(std::string(name) + " cut to " + std::to_string(cut));
      dir_.write(copy, bytes.substr(0, cut));
      const ProgramResult result = measure({"-t", "16x16"});
      ASSERT_EQ(result.exit_code, 0) << result.err;
      const bool whole = cut == bytes.size();
      EXPECT_EQ(report().at("seam_edges_unsampled"), whole ? 0 : 1);
      EXPECT_EQ(count_of(result.err, "warning: "), whole ? 0U : 1U) << result.err;
      EXPECT_EQ(report().at("seam_discrepancy_min"), 7.0);
      ++tried;
    }
  }
  if (tried == 0) GTEST_SKIP() << "no real images here";
}

// Images that are larger than they look, or than memory and disk.

TEST_F(SeamImagesTest, HeaderThatPromisesTooMuchCostsNothing) {
  write_model_of_tiny_parts("bomb.png");
  dir_.write("bomb.png", png_file(100'000, 100'000, false, std::string(100, 'x')));
  dir_.write("report.json", kOld);
  const ProgramResult result = measure({"--memory", "256M", "--threads", "2"});
  if (result.exit_code == 4) return expect_refused_before_work(result, "bomb.png");
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_NE(result.err.find("bomb.png"), std::string::npos) << result.err;
  EXPECT_EQ(report().at("seam_edges_unsampled"), 1);
  if (!ATLASGAUGE_SANITIZED) {
    EXPECT_LT(result.peak_resident_kib, 256 << 10);
  }
}

TEST_F(SeamImagesTest, ImagesThatDoNotFitOnTheDiskAreRefusedBeforeWork) {
  // 300 GB each.
  std::string mtl = "newmtl a\nmap_Kd a.ppm\nnewmtl b\nmap_Kd b.ppm\nnewmtl c\nmap_Kd c0.png\n";
  std::string obj = content_of(file("model.obj"));
  for (int i = 0; i < 40; ++i) {
    const std::string name = "c" + std::to_string(i);
    dir_.write(name + ".png", png_file(100'000, 1'000'000, false, "x"));
    mtl += "newmtl " + name + "\nmap_Kd " + name + ".png\n";
    obj += "usemtl " + name + "\nf 1/1 3/2 4/3\n";
  }
  dir_.write("model.obj", obj);
  dir_.write("model.mtl", mtl);
  dir_.write("report.json", kOld);
  const ProgramResult result = measure({"--tmp-dir", dir_.path().string()});
  expect_refused_before_work(result, "c0.png");
  EXPECT_NE(result.err.find("--tmp-dir"), std::string::npos) << result.err;
  EXPECT_NE(result.err.find("100000 x 1000000"), std::string::npos) << result.err;
}

/// Images that must be held whole to be decoded.
struct LargeImage {
  std::string test, name, size;
  bool decodable;  ///< black
  std::function<std::string()> content;
  std::uint64_t file_bytes = 0;  ///< zeros follow
};

void PrintTo(const LargeImage& image, std::ostream* to) {
  *to << image.name;
}

std::vector<LargeImage> large_images() {
  return {
      {"Tga", "large.tga", "7000 x 6000", true, [] { return tga_header(7000, 6000); },
       std::uint64_t{7000} * 6000 * 3 + 18},
      {"RunLengthBmp", "large.bmp", "12000 x 12500", true,
       [] { return black_rle_bmp_file(12'000, 12'500); }},
      {"InterlacedPng", "large.png", "7000 x 6000", false,
       [] { return png_file(7000, 6000, true, "x"); }},
      {"ProgressiveJpeg", "large.jpg", "7000 x 6000", false,
       [] { return progressive_jpeg_head(7000, 6000); }},
  };
}

class LargeSeamImageTest : public SeamImagesTest, public testing::WithParamInterface<LargeImage> {
 protected:
  void SetUp() override {
    const LargeImage& image = GetParam();
    write_model_of_tiny_parts(image.name);
    dir_.write(image.name, image.content());
    if (image.file_bytes > 0) fs::resize_file(file(image.name), image.file_bytes);
    dir_.write("report.json", kOld);
  }

  /// The number of MiB that the message asks for.
  static std::uint64_t raise_in(const std::string& message) {
    const std::string before = "raise --memory by ";
    const std::size_t at = message.find(before);
    if (at == std::string::npos) return 0;
    return std::stoull(message.substr(at + before.size()));
  }
};

TEST_P(LargeSeamImageTest, IsRefusedBeforeWork) {
  const ProgramResult result = measure({"--memory", "256M"});
  expect_refused_before_work(result, GetParam().name);
  EXPECT_NE(result.err.find(GetParam().size), std::string::npos) << result.err;
  EXPECT_GT(raise_in(result.err), 0U) << result.err;
}

TEST_P(LargeSeamImageTest, PassesWithTheMemoryThatTheRefusalAsksFor) {
  for (const char* threads : {"1", "2", "7"}) {
    dir_.write("report.json", kOld);
    const std::string refusal = measure({"--memory", "256M", "--threads", threads}).err;
    const std::uint64_t mib = 256 + raise_in(refusal);
    const ProgramResult result =
        measure({"--memory", std::to_string(mib) + "M", "--threads", threads});
    ASSERT_EQ(result.exit_code, 0) << refusal << result.err;
    EXPECT_EQ(report().at("seam_edges_unsampled"), GetParam().decodable ? 0 : 1) << result.err;
    if (!ATLASGAUGE_SANITIZED) {
      EXPECT_LT(result.peak_resident_kib, mib << 10) << threads;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, LargeSeamImageTest, testing::ValuesIn(large_images()),
                         [](const auto& instance) { return instance.param.test; });

// Good images.

/// Brighter by 10 a texel upwards.
std::string ramp(std::uint32_t lowest) {
  return ppm_file(8, 8, [lowest](std::uint32_t, std::uint32_t row) {
    const auto level = static_cast<std::uint8_t>(lowest + 10 * (7 - row));
    return Rgb8{level, level, level};
  });
}

TEST_F(SeamImagesTest, StepOnARampHasItsHeightAndTexMetroComparesOppositeEnds) {
  write_model("a.ppm");
  dir_.write("a.ppm", ramp(0));
  dir_.write("b.ppm", ramp(6));
  ASSERT_EQ(measure({"--texmetro-seams"}).exit_code, 0);
  EXPECT_NEAR(report().at("seam_discrepancy_avg"), 6 * std::sqrt(3.0), 1e-12);
  // One side rises from texel 2 to 6, the other one falls, in 20 samples i: they differ by
  // 4 i - 40, and 6 more or less. First seam: 46, 42 ... 2, 2 ... 30, together 416; second seam:
  // 34 ... 2, 2 ... 42, together 404.
  EXPECT_NEAR(report().at("seam_discrepancy_texmetro_avg"), (416 + 404) / 2.0 / 20 * std::sqrt(3.0),
              1e-12);
}

TEST_F(SeamImagesTest, WorstSeamsLieWhereTheyAre) {
  write_model("c.ppm");
  dir_.write("c.ppm", constant_ppm({12, 23, 38}));
  ASSERT_EQ(measure().exit_code, 0);
  const json worst = report().at("worst_seams");
  ASSERT_EQ(worst.size(), 2U);
  EXPECT_EQ(worst[0], json::parse(R"({"discrepancy": 7.0, "length_3d": 1.0, "samples": 20,
      "from": [1.0, 0.0, 0.0], "to": [1.0, 1.0, 0.0], "sides": [
      {"texture": 0, "uv_from": [0.75, 0.25], "uv_to": [0.75, 0.75]},
      {"texture": 1, "uv_from": [0.25, 0.25], "uv_to": [0.25, 0.75]}]})"));
  EXPECT_EQ(worst[1], json::parse(R"({"discrepancy": 2.0, "length_3d": 1.0, "samples": 20,
      "from": [2.0, 0.0, 0.0], "to": [2.0, 1.0, 0.0], "sides": [
      {"texture": 1, "uv_from": [0.75, 0.25], "uv_to": [0.75, 0.75]},
      {"texture": 2, "uv_from": [0.25, 0.25], "uv_to": [0.25, 0.75]}]})"));
}

TEST_F(SeamImagesTest, ImageOfTwoMaterialsIsDecodedOnce) {
  write_model("a.ppm");
  const ProgramResult result = measure({"-v"});
  ASSERT_EQ(result.exit_code, 0);
  EXPECT_NE(result.err.find("seams: 2 images decoded, 128 texels, 40 sample pairs"),
            std::string::npos)
      << result.err;
}

/// Twelve quads in a ring of charts, on images that change from texel to texel.
class VariedSeamsTest : public SeamImagesTest {
 protected:
  VariedSeamsTest() {
    const auto noise = [](std::uint32_t salt) {
      return [salt](std::uint32_t column, std::uint32_t row) {
        const std::uint32_t hash = (column * 73856093U ^ row * 19349663U ^ salt) * 2654435761U;
        return Rgb8{static_cast<std::uint8_t>(hash >> 8), static_cast<std::uint8_t>(hash >> 16),
                    static_cast<std::uint8_t>(hash >> 24)};
      };
    };
    dir_.write("a.ppm", ppm_file(130, 70, noise(1)));
    dir_.write("b.ppm", ppm_file(65, 200, noise(2)));
    dir_.write("c.ppm", ppm_file(1, 3, noise(3)));
    std::string obj = "mtllib model.mtl\n";
    for (int i = 0; i < 13; ++i) {
      obj += "v " + std::to_string(i) + " 0 0\nv " + std::to_string(i) + " 1 0\n";
    }
    for (int i = 0; i < 12; ++i) {
      const std::string left = std::to_string(0.07 * i - 0.3), low = std::to_string(0.11 * i - 0.9);
      const std::string right = std::to_string(0.09 * i), high = std::to_string(0.13 * i + 0.2);
      obj += "vt " + left + " " + low + "\nvt " + right + " " + low + "\nvt " + right + " " + high +
             "\nvt " + left + " " + high + "\nusemtl " + std::string(1, "abc"[i % 3]) + "\n";
      obj += "f " + std::to_string(2 * i + 1) + "/-4 " + std::to_string(2 * i + 3) + "/-3 " +
             std::to_string(2 * i + 4) + "/-2 " + std::to_string(2 * i + 2) + "/-1\n";
    }
    dir_.write("model.obj", obj);
    dir_.write("model.mtl",
               "newmtl a\nmap_Kd a.ppm\nnewmtl b\nmap_Kd b.ppm\nnewmtl c\nmap_Kd c.ppm\n");
  }

  /// What a run with these options writes, without what they add.
  std::vector<std::string> outputs(const std::vector<std::string>& options) const {
    std::vector<std::string> texts;
    for (const std::string name : {"s.csv", "s.jsonl", "s.ply"}) {
      std::vector<std::string> arguments{"--texmetro-seams", "-q", "--seams", file(name)};
      arguments.insert(arguments.end(), options.begin(), options.end());
      const ProgramResult result = measure(arguments);
      EXPECT_EQ(result.exit_code, 0) << result.err;
      texts.push_back(content_of(file(name)));
      texts.push_back(content_of(file("report.json")));
    }
    return texts;
  }
};

TEST_F(VariedSeamsTest, FilesDoNotDependOnMemoryThreadsOrBlocks) {
  const std::vector<std::string> want = outputs({"--memory", "1G", "--threads", "1"});
  EXPECT_GT(json::parse(want[1]).at("seam_discrepancy_avg"), 10);
  EXPECT_EQ(json::parse(want[1]).at("seam_edges"), 11);
  const std::vector<std::vector<std::string>> others = {
      {"--memory", "256M", "--threads", "3"},
      {"--memory", "256M", "--threads", "1"},
      {"--memory", "1G", "--threads", "3"},
      {"--engine-memory", "2M", "--block-bytes", "4096", "--threads", "1"},
      {"--engine-memory", "2M", "--block-bytes", "4096", "--threads", "3"},
  };
  for (const std::vector<std::string>& options : others) {
    EXPECT_EQ(outputs(options), want) << options[1] << " " << options.back();
  }
}

TEST_F(VariedSeamsTest, MapsAndChartsChangeNothing) {
  const std::vector<std::string> want = outputs({});
  EXPECT_EQ(outputs({"--maps", file("maps"), "--charts", file("charts.csv")}), want);
  EXPECT_EQ(names_in(file("maps")).size(), 6U);
  EXPECT_EQ(count_of(content_of(file("charts.csv")), "\n"), 13U);
}

}  // namespace
}  // namespace atlasgauge
