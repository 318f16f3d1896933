#include "measures/corpus/model_run.hpp"

#include <gtest/gtest.h>

#include <csignal>

namespace atlasgauge {
namespace {

ChildEnd ended(int code, std::string_view messages) {
  ChildEnd end;
  end.exit_code = code;
  end.messages.add(messages);
  return end;
}

ChildEnd ended_by(int signal) {
  ChildEnd end = ended(128 + signal, "");
  end.signal = signal;
  return end;
}

TEST(ModelRunTest, AReportComesWithTheCountsOfItsWarnings) {
  const ModelOutcome outcome =
      outcome_of(ended(0, "warning: a\n  model x\nwarnings: 3 faces invalid\n"), "/c");
  EXPECT_EQ(outcome.outcome, Outcome::kMeasured);
  EXPECT_EQ(outcome.warnings, (WarningTotals{{"faces invalid", 3}}));
}

TEST(ModelRunTest, TheReasonOfAFailureIsTheLastMessageWithoutTheRoot) {
  const ModelOutcome outcome =
      outcome_of(ended(3, "warning: x\natlasgauge: /c/a/b.obj:3: '/c/a/x' is no number\n"), "/c");
  EXPECT_EQ(outcome.outcome, Outcome::kFailed);
  EXPECT_EQ(outcome.reason, "a/b.obj:3: 'a/x' is no number");
}

TEST(ModelRunTest, TooLittleMemoryIsNoFaultOfTheModel) {
  EXPECT_EQ(outcome_of(ended(4, "atlasgauge: more\n"), "/c").outcome, Outcome::kRefused);
}

TEST(ModelRunTest, AFaultOfTheProgramIsAFailure) {
  const ModelOutcome outcome = outcome_of(ended(5, ""), "/c");
  EXPECT_EQ(outcome.outcome, Outcome::kFailed);
  EXPECT_EQ(outcome.reason, "ended with exit code 5 and no message");
}

TEST(ModelRunTest, ACrashIsAFailureAndAKillIsNot) {
  EXPECT_EQ(outcome_of(ended_by(SIGSEGV), "/c").outcome, Outcome::kFailed);
  EXPECT_EQ(outcome_of(ended_by(SIGSEGV), "/c").reason,
            "crashed by signal 11 (Segmentation fault)");
  EXPECT_EQ(outcome_of(ended_by(SIGKILL), "/c").outcome, Outcome::kKilled);
  EXPECT_EQ(outcome_of(ended_by(SIGTERM), "/c").outcome, Outcome::kKilled);
}

TEST(ModelRunTest, AReportThatIsCutIsNone) {
  ChildEnd end = ended(0, "");
  end.out_cut = true;
  EXPECT_EQ(outcome_of(end, "/c").outcome, Outcome::kFailed);
}

TEST(ModelRunTest, APathThatLooksLikeAnOptionStaysAPath) {
  const auto words = measure_command("/c/-v.obj", {"--strict"}, {1 << 28, 2, "/t"}).arguments;
  ASSERT_GE(words.size(), 2U);
  EXPECT_EQ(words[words.size() - 2], "--");
}

}  // namespace
}  // namespace atlasgauge
