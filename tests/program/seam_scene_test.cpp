// Seams between random places of textures, whose discrepancies are known in closed form, as a user
// measures them.

#include "bench/seam_scene.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/folder.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

class SeamSceneRunTest : public testing::Test {
 protected:
  static SeamSceneOptions options() {
    SeamSceneOptions options;
    options.edges = 3000;
    options.textures = 6;
    options.texture_size_texels = 256;
    options.image_format = "png";
    options.content = SceneContent::kConstant;
    return options;
  }
  static void SetUpTestSuite() {
    dir_ = new TempDir;
    scene_ = new SeamScene(options());
    write_seam_scene(*scene_, dir_->path().string(), 2);
  }
  static void TearDownTestSuite() {
    delete scene_;
    delete dir_;
  }

  static ProgramResult run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(),
                     {(dir_->path() / "seams.obj").string(), "--json", report()});
    return run_program(ATLASGAUGE_PROGRAM, arguments);
  }
  static std::string report() { return (dir_->path() / "report.json").string(); }
  static std::vector<std::string> wrong_answers() {
    return differences(nlohmann::json::parse(content_of(report())), seam_scene_answers(*scene_));
  }
  static std::string work() {
    return fmt::format("seams: 6 images decoded, {} texels, {} sample pairs\n", 6 * 256 * 256,
                       scene_->sample_pairs());
  }

  inline static const std::vector<std::string> kTiny{"--memory", "256M",          "--engine-memory",
                                                     "2M",       "--block-bytes", "4096"};
  static TempDir* dir_;
  static SeamScene* scene_;
};

TempDir* SeamSceneRunTest::dir_ = nullptr;
SeamScene* SeamSceneRunTest::scene_ = nullptr;

TEST_F(SeamSceneRunTest, ClosedFormsHold) {
  const ProgramResult result = run({"--memory", "256M", "-q"});
  ASSERT_EQ(result.exit_code, 0) << result.err;
  EXPECT_EQ(wrong_answers(), std::vector<std::string>{});
}

TEST_F(SeamSceneRunTest, ClosedFormsHoldInTwoMegabytesForAnyThreads) {
  ASSERT_EQ(run({"--memory", "256M", "-q"}).exit_code, 0);
  const std::string want = content_of(report());
  for (const char* threads : {"1", "3"}) {
    std::vector<std::string> arguments = kTiny;
    arguments.insert(arguments.end(), {"-q", "--threads", threads});
    const ProgramResult result = run(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_EQ(wrong_answers(), std::vector<std::string>{});
    EXPECT_EQ(content_of(report()), want) << threads;
  }
}

TEST_F(SeamSceneRunTest, EveryImageIsDecodedOnceHoweverLittleMemoryThereIs) {
  std::vector<std::string> arguments = kTiny;
  for (const std::vector<std::string>& memory : {kTiny, {"--memory", "256M"}}) {
    arguments = memory;
    arguments.emplace_back("-v");
    const ProgramResult result = run(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.err;
    EXPECT_NE(result.err.find(work()), std::string::npos) << work() << result.err;
  }
}

}  // namespace
}  // namespace atlasgauge
