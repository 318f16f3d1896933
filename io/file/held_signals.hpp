#pragma once

#include <array>
#include <csignal>

namespace atlasgauge {

/// While it lives, signals that ask this program to end wait (for this thread: there must be no
/// other that takes them), so that a file which has a name for a moment does not outlive the run.
class HeldSignals {
 public:
  HeldSignals() {
    sigset_t ending;
    sigemptyset(&ending);
    for (const int number : kEnding) sigaddset(&ending, number);
    ::pthread_sigmask(SIG_BLOCK, &ending, &before_);
  }
  ~HeldSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

  /// True when a signal waits that ends the program as soon as this goes.
  bool end_awaits() const {
    sigset_t waiting;
    sigpending(&waiting);
    for (const int number : kEnding) {
      const bool held_here = sigismember(&before_, number) == 0;
      if (held_here && sigismember(&waiting, number) == 1 && !is_ignored(number)) return true;
    }
    return false;
  }

 private:
  static constexpr std::array kEnding{SIGHUP, SIGINT, SIGQUIT, SIGTERM};

  /// Even ignored signals wait while they are held (see sigpending(2)).
  static bool is_ignored(int number) {
    struct sigaction action {};
    return ::sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
  }

  sigset_t before_{};
};

}  // namespace atlasgauge
