#pragma once

#include <sys/types.h>

#include <cstdint>
#include <string>
#include <vector>

#include "io/file/descriptor.hpp"

namespace atlasgauge {

/// What a child process is to run.
struct ChildCommand {
  std::vector<std::string> arguments;  ///< the program first: an absolute path, or /proc/self/exe
  /// Limit of its private writable memory, enforced by the system: allocations beyond it fail. 0:
  /// none but that of this process. See data_limit().
  std::uint64_t data_bytes = 0;
};

/// A child process from its start on, and the ends of its pipes. Whoever has it must wait for it.
struct StartedChild {
  pid_t pid = -1;
  Descriptor out, err;  ///< read without waiting
  /// Readable once it has ended (see pidfd_open(2)); none where the system has no such thing.
  Descriptor ended;
};

/// Starts a program that ends, by SIGKILL, when this thread does, that the system ends first when
/// memory runs out, and that reads nothing. It has this process's group, environment and folder,
/// but only the three standard descriptors, and no signal blocked; and of those ignored only what
/// nohup and shells ignore for it. The calling process must have no other threads, and its standard
/// descriptors open.
StartedChild start_child(const ChildCommand& command);

}  // namespace atlasgauge
