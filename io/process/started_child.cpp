// A child is made in two steps, fork and exec, with settings in between. Until exec it is a copy of
// this process in which only async-signal-safe calls may be made: all it needs is prepared before,
// and nothing is allocated or thrown. What fails there is told through a pipe that exec closes: the
// parent reads either an errno or the end of the pipe, and knows that the program runs.

#include "io/process/started_child.hpp"

#include <fcntl.h>
#include <linux/close_range.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

struct Pipe {
  Descriptor read_end, write_end;
};

[[noreturn]] void fail_to_start(const ChildCommand& command, int error) {
  errno = error;
  const bool may_pass =
      error == EAGAIN || error == ENOMEM || error == EMFILE || error == ENFILE || error == E2BIG;
  throw Error(may_pass ? ErrorKind::kResource : ErrorKind::kInternal,
              "cannot start " + command.arguments.front() + ": " + errno_text());
}

Pipe make_pipe(const ChildCommand& command) {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) fail_to_start(command, errno);
  return {Descriptor(ends[0]), Descriptor(ends[1])};
}

std::vector<char*> argv_of(const ChildCommand& command) {
  std::vector<char*> argv;
  for (const std::string& argument : command.arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  return argv;
}

/// A limit can be lowered, never raised above the hard one.
rlimit data_limit_of(const ChildCommand& command) {
  rlimit limit{};
  ::getrlimit(RLIMIT_DATA, &limit);
  if (command.data_bytes == 0) return limit;
  const rlim_t bytes = std::min<rlim_t>(command.data_bytes, limit.rlim_cur);
  return {bytes, bytes};
}

/// All that the child needs between fork and exec.
struct Birth {
  char* const* argv;
  pid_t parent;
  int out, err, failure;
  rlimit data;
};

[[noreturn]] void tell_failure(const Birth& birth) {
  const int error = errno;
  // A parent that is gone has no use for it.
  [[maybe_unused]] const ssize_t written = ::write(birth.failure, &error, sizeof(error));
  ::_exit(127);
}

/// The parent may have died before the child asked to die with it.
void die_with_parent(const Birth& birth) {
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) tell_failure(birth);
  if (::getppid() != birth.parent) ::_exit(127);
}

/// When a cgroup's memory runs out, one model is to end, not the run. Not every system lets it.
void be_first_to_go() {
  const int file = ::open("/proc/self/oom_score_adj", O_WRONLY | O_CLOEXEC);
  if (file < 0) return;
  [[maybe_unused]] const ssize_t written = ::write(file, "1000", 4);
  ::close(file);
}

void limit_memory(const Birth& birth) {
  if (::setrlimit(RLIMIT_DATA, &birth.data) != 0) tell_failure(birth);
}

/// The new descriptors are never 0 to 2 themselves, so dup2 always makes one that outlives exec.
void connect_streams(const Birth& birth) {
  const int nothing = ::open("/dev/null", O_RDONLY | O_CLOEXEC);
  if (nothing < 0 || ::dup2(nothing, STDIN_FILENO) < 0 || ::dup2(birth.out, STDOUT_FILENO) < 0 ||
      ::dup2(birth.err, STDERR_FILENO) < 0) {
    tell_failure(birth);
  }
}

/// Whatever this process has inherited or opened otherwise.
void close_others_on_exec() {
  constexpr unsigned kFirst = STDERR_FILENO + 1;
  if (::syscall(SYS_close_range, kFirst, ~0U, CLOSE_RANGE_CLOEXEC) == 0) return;
  constexpr int kUsualLimit = 1024;  // before Linux 5.11
  for (int fd = kFirst; fd < kUsualLimit; ++fd) ::fcntl(fd, F_SETFD, FD_CLOEXEC);
}

/// exec does so with handlers. Under nohup, or in the background of a shell, SIGHUP, SIGINT and
/// SIGQUIT are ignored for the children's sake too.
void reset_signals() {
  struct sigaction usual {};
  usual.sa_handler = SIG_DFL;
  for (int signal = 1; signal < NSIG; ++signal) {
    const bool users = signal == SIGHUP || signal == SIGINT || signal == SIGQUIT;
    if (!users) ::sigaction(signal, &usual, nullptr);
  }
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
}

[[noreturn]] void become_program(const Birth& birth) {
  die_with_parent(birth);
  be_first_to_go();
  limit_memory(birth);
  connect_streams(birth);
  close_others_on_exec();
  reset_signals();
  ::execv(birth.argv[0], birth.argv);
  tell_failure(birth);
}

/// The errno of what failed before the program ran; 0 when it runs.
int failure_read_from(int fd) {
  int error = 0;
  ssize_t bytes = -1;
  do {
    bytes = ::read(fd, &error, sizeof(error));
  } while (bytes < 0 && errno == EINTR);
  return bytes == static_cast<ssize_t>(sizeof(error)) ? error : 0;
}

void wait_for(pid_t pid) {
  while (::waitpid(pid, nullptr, 0) < 0 && errno == EINTR) {
  }
}

Descriptor read_without_waiting(Descriptor end) {
  ::fcntl(end.get(), F_SETFL, O_NONBLOCK);
  return end;
}

}  // namespace

StartedChild start_child(const ChildCommand& command) {
  const std::vector<char*> argv = argv_of(command);
  Pipe out = make_pipe(command);
  Pipe err = make_pipe(command);
  Pipe failure = make_pipe(command);
  const Birth birth{argv.data(),
                    ::getpid(),
                    out.write_end.get(),
                    err.write_end.get(),
                    failure.write_end.get(),
                    data_limit_of(command)};
  const pid_t pid = ::fork();
  if (pid < 0) fail_to_start(command, errno);
  if (pid == 0) become_program(birth);
  failure.write_end = Descriptor();
  if (const int error = failure_read_from(failure.read_end.get()); error != 0) {
    wait_for(pid);
    fail_to_start(command, error);
  }
  const auto ended = static_cast<int>(::syscall(SYS_pidfd_open, pid, 0));
  return {pid, read_without_waiting(std::move(out.read_end)),
          read_without_waiting(std::move(err.read_end)), Descriptor(ended)};
}

}  // namespace atlasgauge
