// One poll waits for everything: output of every child, ends of children, signals that stop the
// run. A child's end is one thing, the end of its pipes another: a program that it left behind may
// hold them for ever. So a child has ended when the system says so; what its pipes hold at that
// moment is read, and they are closed.
//
// A signal that the terminal sends to the whole process group reaches this process before any child
// can be seen to have died of it. As signals are looked for after children, such a death is never
// taken for the child's own.

#include "io/process/child_processes.hpp"

#include <poll.h>
#include <sys/ioctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {

struct ChildProcesses::Child {
  StartedChild process;
  ChildEnd end;
  std::chrono::steady_clock::time_point start = std::chrono::steady_clock::now();
  bool ended = false;
};

namespace {

constexpr std::size_t kReadBytes = 64 << 10;

void add_out(ChildEnd& end, std::string_view text) {
  const std::size_t room = ChildProcesses::kMostOutBytes - end.out.size();
  end.out += text.substr(0, room);
  if (text.size() > room) end.out_cut = true;
}

/// Reads once, without waiting. Returns what was read, 0 when there is nothing now; the descriptor
/// is closed when there will be nothing more.
template <typename Add>
std::size_t read_some(Descriptor& pipe, std::size_t most, const Add& add) {
  std::array<char, kReadBytes> text;
  const ssize_t bytes = ::read(pipe.get(), text.data(), std::min(most, text.size()));
  if (bytes > 0) {
    add(std::string_view(text.data(), static_cast<std::size_t>(bytes)));
    return static_cast<std::size_t>(bytes);
  }
  const bool may_come = bytes < 0 && (errno == EAGAIN || errno == EINTR);
  if (!may_come) pipe = Descriptor();
  return 0;
}

/// Reads what is there now, and no more than that: another process may still write.
template <typename Add>
void read_rest(Descriptor& pipe, const Add& add) {
  int there = 0;
  if (!pipe || ::ioctl(pipe.get(), FIONREAD, &there) != 0) there = 0;
  auto left = static_cast<std::size_t>(there);
  while (left > 0 && pipe) left -= read_some(pipe, left, add);
  pipe = Descriptor();
}

/// False while it runs.
bool reap(pid_t pid, int& status, rusage& usage) {
  pid_t reaped = -1;
  do {
    reaped = ::wait4(pid, &status, WNOHANG, &usage);
  } while (reaped < 0 && errno == EINTR);
  if (reaped < 0) {
    throw Error(ErrorKind::kInternal, "cannot wait for a child process: " + errno_text());
  }
  return reaped == pid;
}

void note_end(ChildEnd& end, int status, const rusage& usage) {
  end.signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
  end.exit_code = end.signal != 0 ? 128 + end.signal : WEXITSTATUS(status);
  end.peak_resident_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

}  // namespace

ChildProcesses::ChildProcesses(StopSignals& stop) : stop_(stop) {
  // Where it is ignored, as some programs leave it to those they start, ends cannot be waited for.
  struct sigaction usual {};
  usual.sa_handler = SIG_DFL;
  ::sigaction(SIGCHLD, &usual, &on_child_before_);
}

ChildProcesses::~ChildProcesses() {
  send(SIGKILL);
  for (const Child& child : children_) {
    if (child.ended) continue;
    while (::waitpid(child.process.pid, nullptr, 0) < 0 && errno == EINTR) {
    }
  }
  ::sigaction(SIGCHLD, &on_child_before_, nullptr);
}

void ChildProcesses::start(std::size_t tag, const ChildCommand& command) {
  children_.emplace_back();
  try {
    children_.back().process = start_child(command);
  } catch (...) {
    children_.pop_back();
    throw;
  }
  children_.back().end.tag = tag;
}

std::size_t ChildProcesses::running() const {
  return children_.size();
}

std::optional<ChildEnd> ChildProcesses::wait() {
  while (true) {
    look_after_all();
    if (stop_.take()) return std::nullopt;
    if (auto end = take_ended()) return end;
    wait_for_news();
  }
}

void ChildProcesses::send(int signal) const {
  for (const Child& child : children_) {
    if (!child.ended) ::kill(child.process.pid, signal);
  }
}

/// Where the end of a child is no event, it is looked for again and again.
void ChildProcesses::wait_for_news() {
  constexpr int kForEver = -1;
  constexpr int kMilliseconds = 20;
  int timeout = kForEver;
  std::vector<pollfd> events{{stop_.descriptor(), POLLIN, 0}};
  for (const Child& child : children_) {
    const StartedChild& process = child.process;
    events.push_back({process.out.get(), POLLIN, 0});  // those closed are negative: never an event
    events.push_back({process.err.get(), POLLIN, 0});
    events.push_back({process.ended.get(), POLLIN, 0});
    if (!process.ended) timeout = kMilliseconds;
  }
  const int found = ::poll(events.data(), events.size(), timeout);
  if (found < 0 && errno != EINTR) {
    throw Error(ErrorKind::kResource, "cannot wait for child processes: " + errno_text());
  }
}

void ChildProcesses::look_after_all() {
  for (Child& child : children_) {
    if (!child.ended) look_after(child);
  }
}

void ChildProcesses::look_after(Child& child) {
  StartedChild& process = child.process;
  const auto add_to_out = [&](std::string_view text) { add_out(child.end, text); };
  const auto add_to_messages = [&](std::string_view text) { child.end.messages.add(text); };
  int status = 0;
  rusage usage{};
  child.ended = reap(process.pid, status, usage);
  if (!child.ended) {
    if (process.out) read_some(process.out, kReadBytes, add_to_out);
    if (process.err) read_some(process.err, kReadBytes, add_to_messages);
    return;
  }
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - child.start;
  child.end.wall_seconds = wall.count();
  note_end(child.end, status, usage);
  read_rest(process.out, add_to_out);
  read_rest(process.err, add_to_messages);
  process.ended = Descriptor();
}

std::optional<ChildEnd> ChildProcesses::take_ended() {
  const auto found = std::find_if(children_.begin(), children_.end(),
                                  [](const Child& child) { return child.ended; });
  if (found == children_.end()) return std::nullopt;
  ChildEnd end = std::move(found->end);
  children_.erase(found);
  return end;
}

}  // namespace atlasgauge
