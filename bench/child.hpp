#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace atlasgauge {

/// What a program that has ended took and left.
struct ChildRun {
  int exit_code = 0;  ///< 128 + n when signal n ended it
  double wall_seconds = 0;
  double user_seconds = 0, system_seconds = 0;
  /// At least that of this program when it started the other: Linux counts from the fork on.
  std::uint64_t peak_resident_bytes = 0;
  std::string out, err;

  double cpu_seconds() const { return user_seconds + system_seconds; }
};

/// Runs a program to its end; `command` begins with its path. What it prints is kept in files in
/// `folder` meanwhile. Throws Error(kResource) where it cannot be started.
ChildRun run_child(const std::vector<std::string>& command, const std::string& folder);

/// The same, for programs that have to succeed: else throws Error(kInternal) with what it printed.
ChildRun run_child_well(const std::vector<std::string>& command, const std::string& folder);

/// The path of a program that lies in the folder of this one.
std::string program_beside(const std::string& name);

}  // namespace atlasgauge
