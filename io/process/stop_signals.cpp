#include "io/process/stop_signals.hpp"

#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdint>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

constexpr std::array kStopping{SIGHUP, SIGINT, SIGTERM};

bool is_ignored(int signal) {
  struct sigaction action {};
  return ::sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

/// A blocked signal arrives even where it is ignored, so those must stay out.
sigset_t stopping_signals() {
  sigset_t set;
  sigemptyset(&set);
  for (const int signal : kStopping) {
    if (!is_ignored(signal)) sigaddset(&set, signal);
  }
  return set;
}

}  // namespace

StopSignals::StopSignals() {
  const sigset_t set = stopping_signals();
  arrivals_ = Descriptor(::signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK));
  if (!arrivals_) throw Error(ErrorKind::kResource, "cannot watch for signals: " + errno_text());
  ::pthread_sigmask(SIG_BLOCK, &set, &before_);
}

StopSignals::~StopSignals() {
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

bool StopSignals::take() {
  signalfd_siginfo arrival{};
  ssize_t bytes = -1;
  do {
    bytes = ::read(arrivals_.get(), &arrival, sizeof(arrival));
  } while (bytes < 0 && errno == EINTR);
  if (bytes != static_cast<ssize_t>(sizeof(arrival))) return false;
  taken_ = static_cast<int>(arrival.ssi_signo);
  return true;
}

void die_by(int signal) {
  std::signal(signal, SIG_DFL);
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, signal);
  ::pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
  ::raise(signal);
  ::_exit(128 + signal);  // by a signal that ends nothing
}

}  // namespace atlasgauge
