// The program as a user meets it: streams, exit codes, messages, files.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/site.hpp"
#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

constexpr const char* kQuad =
    "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nf 1/1 2/2 3/3 4/4\n";

ProgramResult atlasgauge(const std::vector<std::string>& arguments,
                         const std::vector<std::string>& environment = {}) {
  return run_program(ATLASGAUGE_PROGRAM, arguments, environment);
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder),
                                                std::filesystem::directory_iterator()));
}

class CommandTest : public testing::Test {
 protected:
  std::string file(const std::string& name) const { return (dir_.path() / name).string(); }

  TempDir dir_;
  const std::string quad_ = dir_.write("quad.obj", kQuad);
};

TEST_F(CommandTest, ReportOnStandardOutputIsJsonAlone) {
  const ProgramResult run = atlasgauge({quad_, "-t", "256x256", "--json", "-"});
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const nlohmann::json report = nlohmann::json::parse(run.out);
  EXPECT_EQ(report.at("fn"), 2);
  EXPECT_EQ(report.at("area"), 4.0);
  EXPECT_EQ(report.at("area_uv"), 65536.0);
  EXPECT_NE(run.err.find("faces"), std::string::npos) << "the summary goes to standard error";
}

TEST_F(CommandTest, SummaryIsOnStandardOutputOtherwise) {
  const ProgramResult run = atlasgauge({"measure", "-t", "256x256", quad_});
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_NE(run.out.find("quad.obj"), std::string::npos);
  EXPECT_EQ(run.err, "");
}

TEST_F(CommandTest, ReportIsTheSameWhateverTheOptionsOrder) {
  atlasgauge({quad_, "-t", "64x64", "-q", "--json", file("a.json")});
  atlasgauge({"--json", file("b.json"), "-q", "-t", "64x64", quad_});
  EXPECT_EQ(run_program("/usr/bin/cmp", {file("a.json"), file("b.json")}).exit_code, 0);
}

TEST_F(CommandTest, UnknownOptionExitsWithTwo) {
  const ProgramResult run = atlasgauge({quad_, "--frobnicate"});
  EXPECT_EQ(run.exit_code, 2);
  EXPECT_NE(run.err.find("frobnicate"), std::string::npos);
}

TEST_F(CommandTest, BadTextureSizeExitsWithTwo) {
  for (const char* size : {"12", "0x5", "4x", "axb", "1x2x3", "-1x4"}) {
    EXPECT_EQ(atlasgauge({quad_, "-t", size}).exit_code, 2) << size;
  }
}

TEST_F(CommandTest, MissingModelExitsWithThree) {
  const ProgramResult run = atlasgauge({file("none.obj")});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("none.obj"), std::string::npos);
}

TEST_F(CommandTest, DirectoryAsModelExitsWithThree) {
  EXPECT_EQ(atlasgauge({dir_.path().string()}).exit_code, 3);
}

TEST_F(CommandTest, UnreadableNumberNamesTheLineAndLeavesAnOldReport) {
  const std::string model = dir_.write("bad.obj", "v 0 0 0\nv 1 x 0\n");
  const std::string report = dir_.write("report.json", "old");
  const ProgramResult run = atlasgauge({model, "--json", report});
  EXPECT_EQ(run.exit_code, 3);
  EXPECT_NE(run.err.find("bad.obj:2"), std::string::npos) << run.err;
  std::string content;
  std::getline(std::ifstream(report), content);
  EXPECT_EQ(content, "old");
}

TEST_F(CommandTest, TooLittleMemoryExitsWithFourAndNamesWhatWouldDo) {
  const ProgramResult run = atlasgauge({quad_, "--memory", "100M"});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.err.find("256.0 MiB"), std::string::npos) << run.err;
}

TEST_F(CommandTest, UnwritableReportIsRefusedBeforeWork) {
  const ProgramResult run = atlasgauge({quad_, "--json", file("no/such/folder/r.json")});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_EQ(atlasgauge({quad_, "--json", dir_.path().string()}).exit_code, 4);
}

TEST_F(CommandTest, MissingScratchFolderExitsWithFour) {
  SiteOptions options;
  options.faces = 100'000;
  options.image_format = ImageFormat::kNone;
  write_site(Site(options), dir_.path().string());
  const ProgramResult run = atlasgauge(
      {file("site.obj"), "--engine-memory", "3M", "--tmp-dir", file("gone"), "-t", "1024x1024"});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.err.find("--tmp-dir"), std::string::npos) << run.err;
}

TEST_F(CommandTest, ScratchLeavesNothing) {
  SiteOptions options;
  options.faces = 100'000;
  options.image_format = ImageFormat::kNone;
  write_site(Site(options), dir_.path().string());
  std::filesystem::create_directory(file("tmp"));
  const ProgramResult run = atlasgauge({file("site.obj"), "--engine-memory", "3M", "--tmp-dir",
                                        file("tmp"), "-t", "1024x1024", "-v"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_EQ(files_in(file("tmp")), 0U);
  EXPECT_NE(run.err.find("peak resident"), std::string::npos);
}

TEST_F(CommandTest, StrictMakesAWarningAnError) {
  const std::string model = dir_.write("odd.obj", std::string(kQuad) + "f 1 2 99\n");
  EXPECT_EQ(atlasgauge({model, "-t", "8x8"}).exit_code, 0);
  EXPECT_EQ(atlasgauge({model, "-t", "8x8", "--strict"}).exit_code, 3);
}

TEST_F(CommandTest, WarningsGoToStandardErrorAndAreCounted) {
  const std::string model = dir_.write("odd.obj", std::string(kQuad) + "f 1 2 99\n");
  const ProgramResult run = atlasgauge({model, "-t", "8x8", "--json", "-"});
  EXPECT_NE(run.err.find("odd.obj:10"), std::string::npos) << run.err;
  EXPECT_EQ(nlohmann::json::parse(run.out).at("faces_invalid"), 1);
}

TEST_F(CommandTest, VerboseShowsTheMemoryLimitAndItsOrigin) {
  const auto limit_line = [&](const ProgramResult& run) {
    const std::size_t at = run.err.find("memory limit");
    return at == std::string::npos ? "" : run.err.substr(at, run.err.find('\n', at) - at);
  };
  const std::string given = limit_line(atlasgauge({quad_, "-t", "8x8", "-v", "--memory", "300M"}));
  EXPECT_NE(given.find("300.0 MiB  --memory"), std::string::npos) << given;
  const std::string slurm =
      limit_line(atlasgauge({quad_, "-t", "8x8", "-v"}, {"SLURM_MEM_PER_NODE=500"}));
  EXPECT_NE(slurm.find("400.0 MiB  0.8 of SLURM_MEM_PER_NODE"), std::string::npos) << slurm;
  const std::string machine = limit_line(
      atlasgauge({quad_, "-t", "8x8", "-v"}, {"SLURM_MEM_PER_NODE=0", "SLURM_MEM_PER_CPU=0"}));
  EXPECT_NE(machine.find("0.8 of "), std::string::npos) << machine;
  EXPECT_EQ(machine.find("SLURM"), std::string::npos) << machine;
}

TEST_F(CommandTest, RefusedMemoryNamesWhatSetTheLimit) {
  const ProgramResult run = atlasgauge({quad_}, {"SLURM_MEM_PER_NODE=100"});
  EXPECT_EQ(run.exit_code, 4);
  EXPECT_NE(run.err.find("80.0 MiB (0.8 of SLURM_MEM_PER_NODE) is too little"), std::string::npos)
      << run.err;
}

TEST_F(CommandTest, HelpAndVersionExitWithZero) {
  EXPECT_EQ(atlasgauge({"--help"}).exit_code, 0);
  EXPECT_NE(atlasgauge({"--version"}).out.find("atlasgauge"), std::string::npos);
}

TEST_F(CommandTest, PeakResidentStaysUnderTheMemoryLimit) {
  if (ATLASGAUGE_SANITIZED) GTEST_SKIP() << "sanitizers take memory of their own";
  SiteOptions options;
  options.faces = 1'000'000;
  options.texture_size_texels = 1024;
  options.textures = 2;
  write_site(Site(options), dir_.path().string());
  const ProgramResult run = atlasgauge({file("site.obj"), "--memory", "256M", "-q"});
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_LT(run.peak_resident_kib, 256 << 10);
}

}  // namespace
}  // namespace atlasgauge
