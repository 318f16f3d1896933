#pragma once

#include <string>
#include <vector>

namespace atlasgauge {

/// What a finished program left.
struct ProgramResult {
  int exit_code = 0;  ///< 128 + n when signal n ended it
  std::string out;
  std::string err;
  long peak_resident_kib = 0;
  double cpu_seconds = 0;  ///< user and system
  double wall_seconds = 0;
};

/// Runs a program to its end; `arguments` without its name, `environment` as NAME=VALUE on top of
/// the present one.
ProgramResult run_program(const std::string& program, const std::vector<std::string>& arguments,
                          const std::vector<std::string>& environment = {});

}  // namespace atlasgauge
