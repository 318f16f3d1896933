#include "measures/process.hpp"

#include <fcntl.h>
#include <malloc.h>
#include <unistd.h>

#include <csignal>
#include <initializer_list>

namespace atlasgauge {
namespace {

/// Large buffers go back to the system when they are freed: resident memory is what the limit is
/// about, and the allocator's habit of keeping them would break it.
void return_freed_memory() {
  ::mallopt(M_MMAP_THRESHOLD, 64 << 10);
  ::mallopt(M_ARENA_MAX, 2);
}

/// A closed standard stream stays closed: no file that is opened later gets its number, to be
/// written to by mistake. Writing to it fails.
void hold_closed_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(stream, F_GETFD) < 0) ::open("/dev/null", O_RDONLY);
  }
}

/// A file that may grow no larger is an error with a message, not a signal.
void let_large_files_fail() {
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace

void prepare_process() {
  hold_closed_streams();
  let_large_files_fail();
  return_freed_memory();
}

}  // namespace atlasgauge
