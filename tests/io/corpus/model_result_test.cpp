#include "io/corpus/model_result.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

const std::string kDigest = "ab34567890123456789012345678901f";
const std::string kReport = "{\n \"area\": 0.10\n}\n";

class ResultStoreTest : public testing::Test {
 protected:
  ResultStoreTest() { job_.make_folders(); }

  ResultStore store(const std::vector<std::string>& arguments = {}) const {
    return {job_, {"/corpus", 1, arguments}};
  }
  std::vector<fs::path> files() const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::recursive_directory_iterator(job_.results_path())) {
      if (entry.is_regular_file()) files.push_back(entry.path());
    }
    return files;
  }

  TempDir dir_;
  CorpusJob job_{dir_.path().string()};
};

TEST_F(ResultStoreTest, AResultComesBackWithItsReportByteForByte) {
  store().write(kDigest, {"a\xFF.obj", "atlasgauge 1", true, "", {{"faces invalid", 3}}}, kReport);
  const auto result = store().find(kDigest);
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->measured);
  EXPECT_EQ(result->program, "atlasgauge 1");
  EXPECT_EQ(result->warnings, (WarningTotals{{"faces invalid", 3}}));
  EXPECT_EQ(store().report(kDigest), kReport);
}

TEST_F(ResultStoreTest, AFailureHasAReason) {
  store().write(kDigest, {"a.obj", "atlasgauge 1", false, "a.obj:3: line\nend", {}}, "");
  const auto result = store().find(kDigest);
  ASSERT_TRUE(result);
  EXPECT_FALSE(result->measured);
  EXPECT_EQ(result->reason, "a.obj:3: line\nend");
}

TEST_F(ResultStoreTest, WritingTwiceLeavesOneFile) {
  for (int i = 0; i < 2; ++i) store().write(kDigest, {"a.obj", "p", true, "", {}}, kReport);
  EXPECT_EQ(files().size(), 1U);
}

TEST_F(ResultStoreTest, OtherInputsOrArgumentsHaveOtherResults) {
  store().write(kDigest, {"a.obj", "p", true, "", {}}, kReport);
  EXPECT_FALSE(store().find("ff" + kDigest.substr(2)));
  EXPECT_FALSE(store({"-t", "64x64"}).find(kDigest));
  store({"-t", "64x64"}).write(kDigest, {"a.obj", "p", true, "", {}}, kReport);
  EXPECT_FALSE(store({"-t", "64x65"}).find(kDigest));
  EXPECT_TRUE(store({"-t", "64x64"}).find(kDigest));
  EXPECT_EQ(files().size(), 2U);
}

TEST_F(ResultStoreTest, AResultThatIsCutOrLongerIsNotFound) {
  store().write(kDigest, {"a.obj", "p", true, "", {}}, kReport);
  const auto bytes = fs::file_size(files().front());
  fs::resize_file(files().front(), bytes + 1);
  EXPECT_FALSE(store().find(kDigest));
  fs::resize_file(files().front(), bytes - 1);
  EXPECT_FALSE(store().find(kDigest));
}

TEST_F(ResultStoreTest, WhatIsNoResultIsNotFound) {
  store().write(kDigest, {"a.obj", "p", true, "", {}}, kReport);
  for (const char* content : {"", "\n", "garbage\n", "{\"model\": \"a\"}\n", "[]\n"}) {
    std::ofstream(files().front()) << content;
    EXPECT_FALSE(store().find(kDigest)) << content;
  }
}

}  // namespace
}  // namespace atlasgauge
