#include "io/process/stop_signals.hpp"

#include <gtest/gtest.h>
#include <poll.h>

#include <csignal>

#include "tests/io/process/other_process.hpp"

namespace atlasgauge {
namespace {

/// Each test works in a process of its own.
template <typename Function>
int status_of(const Function& function) {
  OtherProcess process(function);
  return process.wait().value_or(-1);
}

bool is_readable(const StopSignals& stop) {
  pollfd event{stop.descriptor(), POLLIN, 0};
  return ::poll(&event, 1, 0) == 1;
}

bool is_blocked(int signal) {
  sigset_t blocked;
  ::pthread_sigmask(SIG_BLOCK, nullptr, &blocked);
  return sigismember(&blocked, signal) == 1;
}

void expect_success(int status) {
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

TEST(StopSignalsTest, EachIsTakenInsteadOfEndingTheProgram) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    expect_success(status_of([&] {
      StopSignals stop;
      if (is_readable(stop) || stop.take() || stop.taken() != 0) return 1;
      ::raise(signal);
      if (!is_readable(stop) || stop.taken() != 0) return 2;
      if (!stop.take() || stop.taken() != signal) return 3;
      return is_readable(stop) || stop.take() || stop.taken() != signal ? 4 : 0;
    }));
  }
}

TEST(StopSignalsTest, OneThatNobodyTookEndsTheProgramAfterwards) {
  const int status = status_of([] {
    {
      StopSignals stop;
      ::raise(SIGTERM);
    }
    return 1;
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
}

TEST(StopSignalsTest, MaskIsRestored) {
  expect_success(status_of([] {
    if (is_blocked(SIGTERM)) return 1;
    {
      StopSignals stop;
      if (!is_blocked(SIGTERM)) return 2;
    }
    return is_blocked(SIGTERM) ? 3 : 0;
  }));
}

TEST(StopSignalsTest, IgnoredSignalsStayIgnored) {
  expect_success(status_of([] {
    std::signal(SIGHUP, SIG_IGN);
    StopSignals stop;
    ::raise(SIGHUP);
    if (stop.take()) return 1;
    ::raise(SIGTERM);
    return stop.take() && stop.taken() == SIGTERM ? 0 : 2;
  }));
}

TEST(StopSignalsTest, DyingByASignalIsSeenOutside) {
  const int status = status_of([] {
    StopSignals stop;
    ::raise(SIGINT);
    if (!stop.take()) return 1;
    die_by(stop.taken());
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGINT);
}

}  // namespace
}  // namespace atlasgauge
