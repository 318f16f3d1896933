#pragma once

#include <csignal>

#include "io/file/descriptor.hpp"

namespace atlasgauge {

/// While it lives, SIGHUP, SIGINT and SIGTERM do not end this program but are read from a
/// descriptor, so that it can end what it has begun. There must be no other thread that takes them.
/// Those that are ignored, as under nohup, stay ignored.
class StopSignals {
 public:
  StopSignals();
  /// One that nobody has taken has its usual effect now.
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Readable while one waits to be taken.
  int descriptor() const { return arrivals_.get(); }
  /// Takes one that has arrived; false when none has. Never waits.
  bool take();
  /// The one taken last; 0 when none was.
  int taken() const { return taken_; }

 private:
  sigset_t before_{};
  Descriptor arrivals_;
  int taken_ = 0;
};

/// Ends this program by a signal, so that whoever started it sees what happened. No destructors
/// run: to be called at the end of main.
[[noreturn]] void die_by(int signal);

}  // namespace atlasgauge
