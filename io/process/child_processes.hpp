#pragma once

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "io/process/message_tail.hpp"
#include "io/process/started_child.hpp"
#include "io/process/stop_signals.hpp"

namespace atlasgauge {

/// How a child process ended, what it wrote and what it took.
struct ChildEnd {
  std::size_t tag = 0;  ///< as given to start()
  int exit_code = 0;    ///< 128 + n when signal n ended it
  int signal = 0;       ///< 0 when it exited by itself
  std::string out;      ///< its standard output, up to ChildProcesses::kMostOutBytes
  bool out_cut = false;
  MessageTail messages;  ///< its standard error
  double wall_seconds = 0;
  /// The system counts from fork on: no less than what the starting process kept for itself.
  std::uint64_t peak_resident_bytes = 0;
};

/// Child processes that run beside each other. Those that still run when it goes are killed.
class ChildProcesses {
 public:
  static constexpr std::size_t kMostOutBytes = 256 << 20;

  /// `stop` must outlive it.
  explicit ChildProcesses(StopSignals& stop);
  ~ChildProcesses();
  ChildProcesses(const ChildProcesses&) = delete;
  ChildProcesses& operator=(const ChildProcesses&) = delete;

  /// See start_child(). The tag tells this child from the others.
  void start(std::size_t tag, const ChildCommand& command);
  /// Those started whose end wait() has not returned.
  std::size_t running() const;
  /// Waits until one of those has ended, with all that it wrote. None when a signal of `stop` came
  /// first, or with it; each ends one wait, so that the caller can go on to wait for the children.
  std::optional<ChildEnd> wait();
  /// Sends a signal to all that run.
  void send(int signal) const;

 private:
  struct Child;

  void wait_for_news();
  void look_after_all();
  static void look_after(Child& child);
  std::optional<ChildEnd> take_ended();

  StopSignals& stop_;
  struct sigaction on_child_before_ {};
  std::vector<Child> children_;
};

}  // namespace atlasgauge
