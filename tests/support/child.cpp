#include "tests/support/child.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace atlasgauge {
namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

void redirect(int to, const std::filesystem::path& path) {
  const int file = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  ::dup2(file, to);
  ::close(file);
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

}  // namespace

Child::Child(const ChildSetup& setup) {
  pid_ = ::fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ == 0) become(setup);
}

Child::~Child() {
  if (pid_ > 0) wait();
}

void Child::become(const ChildSetup& setup) const {
  redirect(STDOUT_FILENO, setup.out.empty() ? dir_.path() / "out" : setup.out);
  redirect(STDERR_FILENO, setup.err.empty() ? dir_.path() / "err" : setup.err);
  for (const int fd : setup.closed) ::close(fd);
  if (setup.user && (::setgid(*setup.user) != 0 || ::setuid(*setup.user) != 0)) ::_exit(126);
  for (const std::string& variable : setup.environment) {
    ::putenv(const_cast<char*>(variable.c_str()));
  }
  std::vector<char*> argv{const_cast<char*>(setup.program.c_str())};
  for (const std::string& argument : setup.arguments) {
    argv.push_back(const_cast<char*>(argument.c_str()));
  }
  argv.push_back(nullptr);
  ::execv(setup.program.c_str(), argv.data());
  ::_exit(127);
}

void Child::send(int signal) const {
  ::kill(pid_, signal);
}

ProgramResult Child::wait() {
  int status = 0;
  rusage usage{};
  ::wait4(std::exchange(pid_, -1), &status, 0, &usage);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start_;
  ProgramResult result;
  result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = text_of(dir_.path() / "out");
  result.err = text_of(dir_.path() / "err");
  result.peak_resident_kib = usage.ru_maxrss;
  result.cpu_seconds = seconds(usage.ru_utime) + seconds(usage.ru_stime);
  result.wall_seconds = wall.count();
  return result;
}

}  // namespace atlasgauge
