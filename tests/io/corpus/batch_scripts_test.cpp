#include "io/corpus/batch_scripts.hpp"

#include <gtest/gtest.h>

#include "io/error.hpp"
#include "tests/support/input_error.hpp"

namespace atlasgauge {
namespace {

TEST(ArrayTextTest, NeighboursAreARange) {
  EXPECT_EQ(array_text({0}), "0");
  EXPECT_EQ(array_text({3, 7, 8, 9}), "3,7-9");
  EXPECT_EQ(array_text({0, 1, 3, 5, 6}), "0-1,3,5-6");
  EXPECT_EQ(array_text({}), "");
}

TEST(ShellWordTest, OnlyWhatAShellWouldReadOtherwiseIsQuoted) {
  EXPECT_EQ(shell_word("/a/b-c_1.obj"), "/a/b-c_1.obj");
  EXPECT_EQ(shell_word("/a b"), "'/a b'");
  EXPECT_EQ(shell_word("it's $HOME"), "'it'\\''s $HOME'");
  EXPECT_EQ(shell_word(""), "''");
}

TEST(BatchScriptsTest, TheArrayHasATaskASlice) {
  const std::string script = corpus_script({"/bin/atlasgauge", "/job", "/job/logs", 24});
  EXPECT_TRUE(says(script, "\n#SBATCH --array=0-23\n"));
  EXPECT_TRUE(says(script, "\n/bin/atlasgauge corpus run /job --slice \"$SLURM_ARRAY_TASK_ID\"\n"));
  EXPECT_TRUE(says(script, "\n#SBATCH --output=\"/job/logs/%A_%a.log\"\n"));
}

TEST(BatchScriptsTest, FoldersWithBlanksQuotesAndPercentsAreQuoted) {
  const std::string script = gather_script({"/my bin/a", "/a \"b\" 5%", "/a \"b\" 5%/logs", 1});
  EXPECT_TRUE(says(script, "\n#SBATCH --output=\"/a \\\"b\\\" 5%%/logs/gather.log\"\n"));
  EXPECT_TRUE(says(script, "\nexec '/my bin/a' corpus gather '/a \"b\" 5%'\n"));
}

TEST(BatchScriptsTest, AFolderWithALineEndIsRefused) {
  EXPECT_THROW(corpus_script({"a", "/b\nc", "/b\nc/logs", 1}), Error);
}

}  // namespace
}  // namespace atlasgauge
