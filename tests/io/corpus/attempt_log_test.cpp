#include "io/corpus/attempt_log.hpp"

#include <gtest/gtest.h>

#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

class AttemptLogTest : public testing::Test {
 protected:
  AttemptLogTest() { job_.make_folders(); }

  TempDir dir_;
  CorpusJob job_{dir_.path().string()};
};

TEST_F(AttemptLogTest, AttemptsOfAllSlicesAreCounted) {
  AttemptLog(job_, "0").began("aa");
  AttemptLog again(job_, "0");
  again.began("aa");
  again.came_to_nothing("aa", "no\nmemory");
  AttemptLog(job_, "all").began("aa");
  AttemptLog(job_, "1").began("bb");
  auto attempts = read_attempts(job_);
  EXPECT_EQ(attempts["aa"].begun, 3U);
  EXPECT_EQ(attempts["aa"].reason, "no\nmemory");
  EXPECT_EQ(attempts["bb"].begun, 1U);
  EXPECT_EQ(attempts["bb"].reason, "");
}

TEST_F(AttemptLogTest, WhatCannotBeReadIsPassedOver) {
  AttemptLog(job_, "1").began("aa");
  dir_.write("attempts/0.tsv", "began\nx\ty\tz\tw\n\nbegan\tcc\t\nbeg");
  dir_.write("attempts/2.tsv", std::string(1 << 20, 'x'));
  auto attempts = read_attempts(job_);
  EXPECT_EQ(attempts["aa"].begun, 1U);
  EXPECT_EQ(attempts["cc"].begun, 1U);
}

TEST_F(AttemptLogTest, ALongReasonIsCut) {
  AttemptLog(job_, "0").came_to_nothing("aa", std::string(1 << 20, 'x'));
  EXPECT_GT(read_attempts(job_)["aa"].reason.size(), 1000U);
  EXPECT_LT(read_attempts(job_)["aa"].reason.size(), 4000U);
}

}  // namespace
}  // namespace atlasgauge
