#include "io/file/input_paths.hpp"

#include <gtest/gtest.h>

#include "io/error.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

using Paths = std::vector<std::string>;

class InputPathsTest : public ::testing::Test {
 protected:
  std::string path(const std::string& name) const { return (dir_.path() / name).string(); }
  TempDir dir_;
};

TEST_F(InputPathsTest, PatternsStandForFilesByNameInTheOrderGiven) {
  for (const char* name : {"b2.drc", "b10.drc", "a.drc", "c.obj"}) dir_.write(name, "");
  EXPECT_EQ(expand_input_paths({path("c.obj"), path("*.drc"), path("[a]*.drc")}),
            (Paths{path("c.obj"), path("a.drc"), path("b10.drc"), path("b2.drc"), path("a.drc")}));
}

TEST_F(InputPathsTest, ANameThatExistsIsNoPattern) {
  dir_.write("a[1].obj", "");
  dir_.write("a1.obj", "");
  EXPECT_EQ(expand_input_paths({path("a[1].obj")}), Paths{path("a[1].obj")});
}

TEST_F(InputPathsTest, MissingFilesAreLeftToTheirReaders) {
  EXPECT_EQ(expand_input_paths({path("none.obj")}), Paths{path("none.obj")});
}

TEST_F(InputPathsTest, APatternWithoutFilesIsAnError) {
  try {
    expand_input_paths({path("*.drc")});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInput);
    EXPECT_NE(std::string(error.what()).find("*.drc"), std::string::npos);
  }
}

}  // namespace
}  // namespace atlasgauge
