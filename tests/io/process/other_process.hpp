#pragma once

#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <exception>
#include <optional>
#include <thread>

namespace atlasgauge {

/// Waits for what should happen soon; false when it does not within a minute.
template <typename Condition>
bool happens(const Condition& condition) {
  using namespace std::chrono_literals;
  const auto end = std::chrono::steady_clock::now() + 60s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(2ms);
  }
  return true;
}

/// A copy of this process, with one thread and no signal ignored, that runs a function and exits
/// with what it returns. Killed at the latest when this goes out of scope.
class OtherProcess {
 public:
  template <typename Function>
  explicit OtherProcess(const Function& function) : pid_(::fork()) {
    if (pid_ == 0) ::_exit(result_of(function));
  }
  ~OtherProcess() {
    if (pid_ < 0) return;
    send(SIGKILL);
    ::waitpid(pid_, nullptr, 0);
  }
  OtherProcess(const OtherProcess&) = delete;
  OtherProcess& operator=(const OtherProcess&) = delete;

  void send(int signal) const { ::kill(pid_, signal); }

  /// Its status as of waitpid(2); none when it does not end.
  std::optional<int> wait() {
    int status = 0;
    if (!happens([&] { return ::waitpid(pid_, &status, WNOHANG) == pid_; })) return std::nullopt;
    pid_ = -1;
    return status;
  }

 private:
  template <typename Function>
  static int result_of(const Function& function) {
    for (const int signal : {SIGHUP, SIGINT, SIGTERM}) std::signal(signal, SIG_DFL);
    try {
      return function();
    } catch (const std::exception&) {
      return 99;
    }
  }

  pid_t pid_;
};

}  // namespace atlasgauge
