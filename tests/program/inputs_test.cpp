// What a user may give as the model.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "bench/draco_cut.hpp"
#include "bench/site.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

constexpr const char* kQuadObj = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n";
constexpr const char* kQuadPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n"
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "2 0 0\n4 0 0\n4 2 0\n2 2 0\n4 0 1 2 3\n";

class InputsTest : public testing::Test {
 protected:
  ProgramResult measure(std::vector<std::string> arguments) {
    arguments.insert(arguments.end(), {"--json", "-"});
    return run_program(ATLASGAUGE_PROGRAM, arguments);
  }
  nlohmann::json report(const std::vector<std::string>& inputs) {
    const ProgramResult run = measure(inputs);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return nlohmann::json::parse(run.out);
  }
  std::string file(const std::string& name) const { return (dir_.path() / name).string(); }

  TempDir dir_;
};

TEST_F(InputsTest, SeveralFilesAreOneModel) {
  const nlohmann::json json =
      report({dir_.write("quad.obj", kQuadObj), dir_.write("next.ply", kQuadPly)});
  EXPECT_EQ(json.at("mesh"), "quad.obj and 1 more");
  EXPECT_EQ(json.at("fn"), 4);
  EXPECT_EQ(json.at("area"), 8);
  EXPECT_EQ(json.at("vndup"), 2) << "they meet at x = 2";
  EXPECT_EQ(json.at("connected_components"), 2) << "at the raw level";
  EXPECT_EQ(json.at("num_charts"), 1) << "at the uv level";
  EXPECT_FALSE(json.contains("quantization"));
}

TEST_F(InputsTest, APatternInQuotesIsExpanded) {
  dir_.write("a.ply", kQuadPly);
  dir_.write("b.obj", kQuadObj);
  EXPECT_EQ(report({file("*.*")}).at("mesh"), "a.ply and 1 more");
}

TEST_F(InputsTest, APatternWithoutFilesExitsWithThree) {
  const ProgramResult run = measure({file("*.drc")});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("no file matches"), std::string::npos) << run.err;
}

TEST_F(InputsTest, OneBrokenFileOfSeveralIsAnErrorThatNamesIt) {
  const std::string whole = dir_.write("a.ply", kQuadPly);
  const std::string broken =
      dir_.write("b.ply", std::string(kQuadPly, std::string_view(kQuadPly).size() - 8));
  const ProgramResult run = measure({whole, broken});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("b.ply"), std::string::npos) << run.err;
  EXPECT_EQ(run.out, "");
}

TEST_F(InputsTest, CutFilesOfEveryFormatExitWithThree) {
  for (const char* name : {"a.drc", "a.glb", "a.gltf", "a.b3dm", "a.ply", "tileset.json"}) {
    for (const char* content : {"", "{", "DRACO", "glTF", "b3dm", "ply\n"}) {
      EXPECT_EQ(measure({dir_.write(name, content)}).exit_code, 3) << name << ' ' << content;
    }
  }
}

TEST_F(InputsTest, AStreamBeyondTheMemoryIsRefusedWithItsNeed) {
  SiteOptions options;
  options.faces = 200'000;
  options.image_format = ImageFormat::kNone;
  write_site(Site(options), dir_.path().string());
  cut_into_draco(file("site.obj"), {}, file("cut"));
  const std::string stream = file("cut/site_00000.drc");
  const ProgramResult run = measure({stream, "--engine-memory", "4M", "-t", "64x64"});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.err.find("decoding a part of " + stream), std::string::npos) << run.err;
  EXPECT_EQ(measure({stream, "--memory", "256M", "-t", "64x64"}).exit_code, 0);
}

TEST_F(InputsTest, EstimatesCountPartsByTheirHeaders) {
  const ProgramResult run = measure({dir_.write("a.ply", kQuadPly), "--estimate"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out).at("positions"), 4);
}

}  // namespace
}  // namespace atlasgauge
