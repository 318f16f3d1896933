#include "bench/child.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

void redirect(int to, const std::string& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(file, to);
  ::close(file);
}

[[noreturn]] void become(const std::vector<std::string>& command, const std::string& out,
                         const std::string& err) {
  redirect(STDOUT_FILENO, out);
  redirect(STDERR_FILENO, err);
  std::vector<char*> arguments;
  arguments.reserve(command.size() + 1);
  for (const std::string& argument : command) {
    arguments.push_back(const_cast<char*>(argument.c_str()));
  }
  arguments.push_back(nullptr);
  ::execv(arguments[0], arguments.data());
  ::_exit(127);
}

std::string take_text(const std::string& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  std::filesystem::remove(path);
  return text.str();
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

ChildRun run_child(const std::vector<std::string>& command, const std::string& folder) {
  const std::string out = folder + "/out.txt", err = folder + "/err.txt";
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = ::fork();
  if (child < 0) throw Error(ErrorKind::kResource, command[0], 0, errno_text());
  if (child == 0) become(command, out, err);
  int status = 0;
  rusage usage{};
  if (::wait4(child, &status, 0, &usage) != child) {
    throw Error(ErrorKind::kResource, command[0], 0, errno_text());
  }
  ChildRun run;
  run.wall_seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  run.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  run.user_seconds = seconds(usage.ru_utime);
  run.system_seconds = seconds(usage.ru_stime);
  run.peak_resident_bytes = static_cast<std::uint64_t>(usage.ru_maxrss) << 10;
  run.out = take_text(out);
  run.err = take_text(err);
  return run;
}

ChildRun run_child_well(const std::vector<std::string>& command, const std::string& folder) {
  ChildRun run = run_child(command, folder);
  if (run.exit_code != 0) {
    throw Error(ErrorKind::kInternal, command[0] + " ended with " + std::to_string(run.exit_code) +
                                          ":\n" + run.out + run.err);
  }
  return run;
}

std::string program_beside(const std::string& name) {
  return std::filesystem::read_symlink("/proc/self/exe").parent_path() / name;
}

}  // namespace atlasgauge
