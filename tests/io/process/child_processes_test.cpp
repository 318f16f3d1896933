#include "io/process/child_processes.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <thread>

#include "io/error.hpp"
#include "tests/io/process/other_process.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kMiB = 1 << 20;

ChildCommand shell(const std::string& script) {
  return {{"/bin/sh", "-c", script}};
}

class ChildProcessesTest : public testing::Test {
 protected:
  /// How a shell that runs a script ends.
  ChildEnd run(const std::string& script) {
    children_.start(0, shell(script));
    return wait();
  }
  ChildEnd wait() { return children_.wait().value(); }

  /// The path of a file as text for a script.
  std::string file(const std::string& name) const { return (dir_.path() / name).string(); }
  /// The number that a script writes there. It writes beside and renames: no half number is seen.
  int number_in(const std::string& name) const {
    int number = 0;
    happens([&] { return static_cast<bool>(std::ifstream(file(name)) >> number); });
    return number;
  }
  /// A script that writes its process id to a file and sleeps.
  std::string sleeper(const std::string& name) const {
    return "echo $$ > " + file(name + "~") + "; mv " + file(name + "~") + " " + file(name) +
           "; exec sleep 600";
  }

  TempDir dir_;
  StopSignals stop_;
  ChildProcesses children_{stop_};
};

TEST_F(ChildProcessesTest, OutputMessagesAndExitCodeAreTold) {
  children_.start(7, shell("echo result; echo 'warning: w' >&2; echo 'atlasgauge: e' >&2; exit 3"));
  EXPECT_EQ(children_.running(), 1U);
  const ChildEnd end = wait();
  EXPECT_EQ(children_.running(), 0U);
  EXPECT_EQ(end.tag, 7U);
  EXPECT_EQ(end.exit_code, 3);
  EXPECT_EQ(end.signal, 0);
  EXPECT_EQ(end.out, "result\n");
  EXPECT_FALSE(end.out_cut);
  EXPECT_EQ(end.messages.text(), "warning: w\natlasgauge: e\n");
}

TEST_F(ChildProcessesTest, ArgumentsArriveAsTheyAre) {
  children_.start(0, {{"/bin/sh", "-c", "printf '%s|' \"$@\"", "sh", "a b", "", "$x'\""}});
  EXPECT_EQ(wait().out, "a b||$x'\"|");
}

TEST_F(ChildProcessesTest, TheProgramItselfCanBeTheChild) {
  children_.start(
      0, {{"/proc/self/exe", "--gtest_list_tests", "--gtest_filter=ChildProcessesTest.*"}});
  EXPECT_NE(wait().out.find("TheProgramItselfCanBeTheChild"), std::string::npos);
}

TEST_F(ChildProcessesTest, AProgramThatCannotRunIsAnError) {
  for (const auto& [program, reason] : std::map<std::string, std::string>{
           {file("missing"), "No such file or directory"},
           {dir_.write("not executable", "text"), "Permission denied"}}) {
    try {
      children_.start(0, {{program}});
      ADD_FAILURE() << program;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::kInternal);
      EXPECT_EQ(error.what(), "cannot start " + program + ": " + reason);
    }
  }
  EXPECT_EQ(children_.running(), 0U);
  EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1) << "something is left";
  EXPECT_EQ(run("exit 5").exit_code, 5);
}

TEST_F(ChildProcessesTest, ArgumentsBeyondWhatTheSystemTakesAreALackOfResources) {
  try {
    children_.start(0, {{"/bin/true", std::string(64 * kMiB, 'x')}});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kResource);
  }
}

TEST_F(ChildProcessesTest, DeathByASignalIsTold) {
  const ChildEnd end = run("kill -9 $$");
  EXPECT_EQ(end.signal, SIGKILL);
  EXPECT_EQ(end.exit_code, 128 + SIGKILL);
}

TEST_F(ChildProcessesTest, AnExitCodeThatLooksLikeASignalIsNone) {
  const ChildEnd end = run("exit 137");
  EXPECT_EQ(end.signal, 0);
  EXPECT_EQ(end.exit_code, 137);
}

TEST_F(ChildProcessesTest, MuchOutputOnBothStreamsDoesNotBlock) {
  const ChildEnd end =
      run("head -c 3000000 /dev/zero; head -c 3000000 /dev/zero | tr '\\0' x >&2;"
          "head -c 3000000 /dev/zero & head -c 3000000 /dev/zero >&2; wait; echo end >&2");
  EXPECT_EQ(end.exit_code, 0);
  EXPECT_EQ(end.out.size(), 6000000U);
  EXPECT_FALSE(end.out_cut);
  EXPECT_EQ(end.messages.text().substr(MessageTail::kBytes - 4), "end\n");
}

TEST_F(ChildProcessesTest, OutputBeyondTheMostIsCutAndTheChildGoesOn) {
  constexpr std::size_t kMost = ChildProcesses::kMostOutBytes;
  const ChildEnd end = run("head -c " + std::to_string(kMost + 1) + " /dev/zero; exit 4");
  EXPECT_EQ(end.out.size(), kMost);
  EXPECT_TRUE(end.out_cut);
  EXPECT_EQ(end.exit_code, 4);
  const ChildEnd whole = run("head -c " + std::to_string(kMost) + " /dev/zero");
  EXPECT_EQ(whole.out.size(), kMost);
  EXPECT_FALSE(whole.out_cut);
}

TEST_F(ChildProcessesTest, ClosedStreamsAreNotTheEnd) {
  const ChildEnd end = run("echo a; exec >&- 2>&-; read x < /dev/null; sleep 0.1; exit 6");
  EXPECT_EQ(end.out, "a\n");
  EXPECT_EQ(end.exit_code, 6);
}

TEST_F(ChildProcessesTest, WhatAnEndedChildHasLeftInItsPipesIsRead) {
  children_.start(0, shell("echo out; echo err >&2"));
  siginfo_t ended{};
  ASSERT_TRUE(happens([&] {
    return ::waitid(P_ALL, 0, &ended, WEXITED | WNOWAIT | WNOHANG) == 0 && ended.si_pid != 0;
  }));
  const ChildEnd end = wait();
  EXPECT_EQ(end.out, "out\n");
  EXPECT_EQ(end.messages.text(), "err\n");
}

TEST_F(ChildProcessesTest, AProgramLeftBehindThatHoldsThePipesIsNotWaitedFor) {
  const ChildEnd end = run("(" + sleeper("left") + ") & echo out; echo err >&2; exit 2");
  EXPECT_EQ(end.exit_code, 2);
  EXPECT_EQ(end.out, "out\n");
  EXPECT_EQ(end.messages.text(), "err\n");
  EXPECT_LT(end.wall_seconds, 300);
  ::kill(number_in("left"), SIGKILL);
}

TEST_F(ChildProcessesTest, AProgramLeftBehindThatWritesForEverIsNotWaitedFor) {
  const ChildEnd end = run("yes & echo $! >&2; sleep 0.2; exit 2");
  EXPECT_EQ(end.exit_code, 2);
  ::kill(std::stoi(end.messages.text()), SIGKILL);  // if its closed pipe has not ended it
}

TEST_F(ChildProcessesTest, PeakMemoryIsReported) {
  EXPECT_GT(run("x=$(head -c 67108864 /dev/zero | tr '\\0' x); exit 0").peak_resident_bytes,
            64 * kMiB);
}

TEST_F(ChildProcessesTest, MemoryIsLimited) {
  ChildCommand command = shell("ulimit -d; x=$(head -c 134217728 /dev/zero | tr '\\0' x); exit 0");
  command.data_bytes = 64 * kMiB;
  children_.start(0, command);
  const ChildEnd end = wait();
  EXPECT_EQ(end.out, "65536\n");
  EXPECT_NE(end.exit_code, 0);
}

TEST_F(ChildProcessesTest, MemoryIsNotLimitedUnlessAsked) {
  rlimit own{};
  ASSERT_EQ(::getrlimit(RLIMIT_DATA, &own), 0);
  const std::string limit =
      own.rlim_cur == RLIM_INFINITY ? "unlimited" : std::to_string(own.rlim_cur / 1024);
  EXPECT_EQ(run("ulimit -d").out, limit + "\n");
}

TEST_F(ChildProcessesTest, ALimitOfMemoryIsNeverRaised) {
  OtherProcess process([] {
    const rlimit limit{512 * kMiB, 1024 * kMiB};
    ::setrlimit(RLIMIT_DATA, &limit);
    StopSignals stop;
    ChildProcesses children(stop);
    ChildCommand command = shell("[ $(ulimit -d) = 524288 ]");
    command.data_bytes = 4096 * kMiB;
    children.start(0, command);
    return children.wait().value().exit_code;
  });
  EXPECT_EQ(process.wait().value(), 0);
}

TEST_F(ChildProcessesTest, TimesAreReported) {
  const ChildEnd end = run("i=0; while [ $i -lt 100000 ]; do i=$((i+1)); done; sleep 0.3");
  EXPECT_GT(end.wall_seconds, 0.3);
}

TEST_F(ChildProcessesTest, ChildrenAreTheFirstToGoWhenMemoryRunsOut) {
  EXPECT_EQ(run("cat /proc/self/oom_score_adj").out, "1000\n");
}

TEST_F(ChildProcessesTest, ChildrenReadNothing) {
  const std::string input = dir_.write("input", "text");
  OtherProcess process([&] {
    if (::dup2(::open(input.c_str(), O_RDONLY), STDIN_FILENO) < 0) return 1;
    StopSignals stop;
    ChildProcesses children(stop);
    children.start(0, shell("cat; readlink /proc/self/fd/0"));
    return children.wait().value().out == "/dev/null\n" ? 0 : 2;
  });
  EXPECT_EQ(process.wait().value(), 0);
}

TEST_F(ChildProcessesTest, ChildrenHaveOnlyTheStandardDescriptors) {
  const int open = ::open("/dev/null", O_RDONLY);  // without O_CLOEXEC
  children_.start(1, shell("exec sleep 600"));
  children_.start(0,
                  shell("for fd in 3 4 5 6 7 8 9 " + std::to_string(open) +
                        "; do [ -e /proc/$$/fd/$fd ] && readlink /proc/$$/fd/$fd; done; exit 0"));
  EXPECT_EQ(wait().out, "");
  ::close(open);
}

TEST_F(ChildProcessesTest, ChildrenAreInTheGroupOfTheirParent) {
  const ChildEnd end = run("cut -d ' ' -f 5 /proc/self/stat");
  EXPECT_EQ(end.out, std::to_string(::getpgrp()) + "\n");
}

std::string line_of(const std::string& status, const std::string& key) {
  const std::size_t at = status.find(key);
  return status.substr(at, status.find('\n', at) - at);
}

TEST_F(ChildProcessesTest, ChildrenHaveNoSignalBlockedOrIgnored) {
  const auto before = std::signal(SIGXFSZ, SIG_IGN);
  children_.start(0, {{"/bin/cat", "/proc/self/status"}});
  const std::string status = wait().out;
  std::signal(SIGXFSZ, before);
  EXPECT_EQ(line_of(status, "SigBlk"), "SigBlk:\t0000000000000000");
  constexpr std::uint64_t kUsers =
      (1U << (SIGHUP - 1)) | (1U << (SIGINT - 1)) | (1U << (SIGQUIT - 1));
  const std::string ignored = line_of(status, "SigIgn");
  EXPECT_EQ(std::stoull(ignored.substr(ignored.find('\t')), nullptr, 16) & ~kUsers, 0U);
}

TEST_F(ChildProcessesTest, ChildrenUnderNohupIgnoreHangups) {
  const auto before = std::signal(SIGHUP, SIG_IGN);
  EXPECT_EQ(run("kill -HUP $$; exit 3").exit_code, 3);
  std::signal(SIGHUP, before);
}

TEST_F(ChildProcessesTest, ChildrenAreSeenToEndWhereTheirEndsAreIgnored) {
  OtherProcess process([] {
    std::signal(SIGCHLD, SIG_IGN);
    StopSignals stop;
    ChildProcesses children(stop);
    children.start(0, shell("exit 3"));
    return children.wait().value().exit_code;
  });
  EXPECT_EQ(WEXITSTATUS(process.wait().value()), 3);
}

TEST_F(ChildProcessesTest, ManyRunAtOnceAndEachIsToldOnce) {
  constexpr std::size_t kChildren = 64;
  std::set<std::size_t> ended;
  for (std::size_t tag = 0; tag < kChildren; ++tag) {
    children_.start(tag, shell("echo " + std::to_string(tag) +
                               "; head -c 100000 /dev/zero >&2; exit " + std::to_string(tag)));
  }
  EXPECT_EQ(children_.running(), kChildren);
  while (children_.running() > 0) {
    const ChildEnd end = wait();
    EXPECT_EQ(end.out, std::to_string(end.tag) + "\n");
    EXPECT_EQ(end.exit_code, static_cast<int>(end.tag));
    ended.insert(end.tag);
  }
  EXPECT_EQ(ended.size(), kChildren);
}

TEST_F(ChildProcessesTest, TheFirstToEndIsTheFirstTold) {
  children_.start(0, shell("exec sleep 600"));
  children_.start(1, shell("exit 1"));
  EXPECT_EQ(wait().tag, 1U);
  EXPECT_EQ(children_.running(), 1U);
}

TEST_F(ChildProcessesTest, ASignalIsSentToAll) {
  children_.start(0, shell("exec sleep 600"));
  children_.start(1, shell("exec sleep 600"));
  children_.send(SIGTERM);
  EXPECT_EQ(wait().signal, SIGTERM);
  EXPECT_EQ(wait().signal, SIGTERM);
}

/// Whether a process that was a child of another, and became one of this process, has been killed.
bool is_killed(pid_t pid) {
  int status = 0;
  return happens([&] { return ::waitpid(pid, &status, WNOHANG) == pid; }) && WIFSIGNALED(status) &&
         WTERMSIG(status) == SIGKILL;
}

/// While it lives, orphans below this process become its children.
class Orphanage {
 public:
  Orphanage() { ::prctl(PR_SET_CHILD_SUBREAPER, 1); }
  ~Orphanage() { ::prctl(PR_SET_CHILD_SUBREAPER, 0); }
  Orphanage(const Orphanage&) = delete;
  Orphanage& operator=(const Orphanage&) = delete;
};

TEST_F(ChildProcessesTest, AKilledParentTakesItsChildrenAlong) {
  const Orphanage orphanage;
  OtherProcess parent([&] {
    StopSignals stop;
    ChildProcesses children(stop);
    children.start(0, shell(sleeper("a")));
    children.start(1, shell(sleeper("b")));
    children.wait();
    return 1;
  });
  const int a = number_in("a");
  const int b = number_in("b");
  parent.send(SIGKILL);
  EXPECT_EQ(WTERMSIG(parent.wait().value()), SIGKILL);
  EXPECT_TRUE(is_killed(a));
  EXPECT_TRUE(is_killed(b));
  ::kill(a, SIGKILL);
  ::kill(b, SIGKILL);
}

TEST_F(ChildProcessesTest, ChildrenDoNotOutliveTheObject) {
  pid_t pid = 0;
  {
    ChildProcesses children(stop_);
    children.start(0, shell("trap '' TERM INT; " + sleeper("pid")));
    pid = number_in("pid");
    EXPECT_EQ(::kill(pid, 0), 0);
  }
  EXPECT_EQ(::kill(pid, 0), -1);
}

TEST_F(ChildProcessesTest, ASignalToStopEndsTheWait) {
  OtherProcess parent([&] {
    StopSignals stop;
    {
      ChildProcesses children(stop);
      children.start(0, shell(sleeper("pid")));
      if (children.wait()) return 1;
      children.send(stop.taken());
      const auto end = children.wait();  // goes on
      if (!end || end->signal != SIGTERM) return 2;
    }
    die_by(stop.taken());
  });
  const int child = number_in("pid");
  EXPECT_EQ(::kill(child, 0), 0);
  parent.send(SIGTERM);
  const int status = parent.wait().value();
  ASSERT_TRUE(WIFSIGNALED(status)) << WEXITSTATUS(status);
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
}

TEST_F(ChildProcessesTest, ASignalToTheWholeGroupIsSeenBeforeTheDeathsItCauses) {
  for (int i = 0; i < 20; ++i) {
    OtherProcess parent([&] {
      ::setpgid(0, 0);
      StopSignals stop;
      ChildProcesses children(stop);
      for (std::size_t tag = 0; tag < 4; ++tag) children.start(tag, shell("exec sleep 600"));
      children.start(4, shell("kill -INT 0; exec sleep 600"));
      if (children.wait()) return 1;
      while (children.running() > 0) {
        if (children.wait().value().signal != SIGINT) return 2;
      }
      return stop.taken();
    });
    const int status = parent.wait().value();
    ASSERT_TRUE(WIFEXITED(status));
    ASSERT_EQ(WEXITSTATUS(status), SIGINT);
  }
}

TEST_F(ChildProcessesTest, WhereASystemGivesNoDescriptorsThatIsAnError) {
  OtherProcess process([] {
    StopSignals stop;
    ChildProcesses children(stop);
    const rlimit few{6, 6};
    ::setrlimit(RLIMIT_NOFILE, &few);
    try {
      children.start(0, shell("exit 0"));
    } catch (const Error& error) {
      return static_cast<int>(error.kind());
    }
    return 0;
  });
  EXPECT_EQ(WEXITSTATUS(process.wait().value()), static_cast<int>(ErrorKind::kResource));
}

}  // namespace
}  // namespace atlasgauge
