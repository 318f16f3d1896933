#pragma once

#include <sys/types.h>

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/program.hpp"
#include "tests/support/temp_dir.hpp"

namespace atlasgauge {

/// How to start a program.
struct ChildSetup {
  std::string program;
  std::vector<std::string> arguments;    ///< without its name
  std::vector<std::string> environment;  ///< NAME=VALUE, on top of the present one
  std::filesystem::path out, err;        ///< files to write to; empty: kept for the result
  std::vector<int> closed;               ///< file descriptors that it does not get
  std::optional<uid_t> user;
};

/// A running program. Waited for at the latest when it goes out of scope.
class Child {
 public:
  explicit Child(const ChildSetup& setup);
  ~Child();
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  pid_t pid() const { return pid_; }
  void send(int signal) const;
  ProgramResult wait();

 private:
  [[noreturn]] void become(const ChildSetup& setup) const;

  TempDir dir_;
  pid_t pid_ = -1;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace atlasgauge
