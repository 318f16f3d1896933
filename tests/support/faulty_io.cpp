// Preloaded into a program (LD_PRELOAD) to make its system calls fail as told by FAULTY_IO, a list
// of rules separated by blanks:
//
//   CALL[@TEXT]:WHICH:FAULT
//
// CALL   read, pread, write, pwrite, open, direct (open with O_DIRECT), unnamed (open with
//        O_TMPFILE), fsync, linkat, rename
// @TEXT  only where the file's path contains TEXT
// WHICH  5: the fifth call; 5+: that and all later; every5: each fifth
// FAULT  an errno by name; short100: at most 100 bytes pass; zero: no byte passes, without an
//        error; signal15: the process gets that signal first; shrink: the file is cut to nothing
//        first; remove_folder: the folder of the report (FAULTY_FOLDER) is removed first
//
// FAULTY_IO_COUNTS names a file that the numbers of calls are written to at the end.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

constexpr std::size_t kAllBytes = std::numeric_limits<std::size_t>::max();

struct Rule {
  std::string call, path_part;
  std::uint64_t first = 1, last = 1, step = 1;
  int error = 0;
  std::size_t most_bytes = kAllBytes;
  int signal = 0;
  bool shrink = false;
  bool remove_folder = false;
  std::atomic<std::uint64_t> calls{0};

  bool hits(std::uint64_t number) const {
    return number >= first && number <= last && number % step == 0;
  }
};

int errno_named(const std::string& name) {
  static const std::map<std::string, int> kNumbers = {
      {"EACCES", EACCES}, {"EINTR", EINTR},           {"EINVAL", EINVAL}, {"EIO", EIO},
      {"ENOSPC", ENOSPC}, {"EOPNOTSUPP", EOPNOTSUPP}, {"EPERM", EPERM},   {"EDQUOT", EDQUOT}};
  return kNumbers.at(name);
}

void set_which(Rule& rule, const std::string& which) {
  if (which.starts_with("every")) {
    rule.step = std::stoull(which.substr(5));
    rule.last = std::numeric_limits<std::uint64_t>::max();
    return;
  }
  rule.first = std::stoull(which);
  rule.last = which.ends_with('+') ? std::numeric_limits<std::uint64_t>::max() : rule.first;
}

void set_fault(Rule& rule, const std::string& fault) {
  if (fault.starts_with("short")) {
    rule.most_bytes = std::stoull(fault.substr(5));
  } else if (fault == "zero") {
    rule.most_bytes = 0;
  } else if (fault.starts_with("signal")) {
    rule.signal = std::stoi(fault.substr(6));
  } else if (fault == "shrink") {
    rule.shrink = true;
  } else if (fault == "remove_folder") {
    rule.remove_folder = true;
  } else {
    rule.error = errno_named(fault);
  }
}

void set_rule(Rule& rule, const std::string& text) {
  const std::size_t first = text.find(':');
  const std::size_t second = text.find(':', first + 1);
  const std::string call = text.substr(0, first);
  rule.call = call.substr(0, call.find('@'));
  rule.path_part = call.find('@') == std::string::npos ? "" : call.substr(call.find('@') + 1);
  set_which(rule, text.substr(first + 1, second - first - 1));
  set_fault(rule, text.substr(second + 1));
}

/// What a call is to do.
struct Fault {
  int error = 0;
  std::size_t most_bytes = kAllBytes;
};

class Faults {
 public:
  Faults() {
    const char* rules = std::getenv("FAULTY_IO");
    if (rules == nullptr) return;
    std::istringstream words(rules);
    std::vector<std::string> texts;
    for (std::string text; words >> text;) texts.push_back(text);
    rules_ = std::vector<Rule>(texts.size());
    for (std::size_t i = 0; i < texts.size(); ++i) set_rule(rules_[i], texts[i]);
  }
  ~Faults() {
    const char* path = std::getenv("FAULTY_IO_COUNTS");
    if (path == nullptr) return;
    std::ofstream counts(path);
    for (const Rule& rule : rules_) counts << rule.call << ' ' << rule.calls << '\n';
  }
  Faults(const Faults&) = delete;
  Faults& operator=(const Faults&) = delete;

  Fault on(const char* call, const std::string& path) {
    Fault fault;
    for (Rule& rule : rules_) {
      if (rule.call != call || path.find(rule.path_part) == std::string::npos) continue;
      if (!rule.hits(++rule.calls)) continue;
      if (rule.signal != 0) ::kill(::getpid(), rule.signal);
      if (rule.shrink) std::filesystem::resize_file(path, 0);
      if (rule.remove_folder) std::filesystem::remove_all(std::getenv("FAULTY_FOLDER"));
      if (rule.error != 0) fault.error = rule.error;
      fault.most_bytes = std::min(fault.most_bytes, rule.most_bytes);
    }
    return fault;
  }

  Fault on(const char* call, int fd) {
    if (!asks_for_path(call)) return on(call, std::string());
    char path[4096] = {};
    const std::string link = "/proc/self/fd/" + std::to_string(fd);
    if (::readlink(link.c_str(), path, sizeof(path) - 1) < 0) path[0] = '\0';
    return on(call, path);
  }

 private:
  bool asks_for_path(const char* call) const {
    return std::ranges::any_of(
        rules_, [&](const Rule& rule) { return rule.call == call && !rule.path_part.empty(); });
  }

  std::vector<Rule> rules_;
};

Faults& faults() {
  static Faults all;
  return all;
}

template <class Function>
Function next(const char* name) {
  return reinterpret_cast<Function>(::dlsym(RTLD_NEXT, name));
}

template <class Result, class Call>
Result unless_faulty(const Fault& fault, Call call) {
  if (fault.error == 0) return call();
  errno = fault.error;
  return -1;
}

int faulty_open(const char* path, int flags, mode_t mode) {
  static const auto real = next<int (*)(const char*, int, ...)>("open");
  const bool unnamed = (flags & O_TMPFILE) == O_TMPFILE;
  Fault fault = faults().on("open", path);
  if (fault.error == 0 && unnamed) fault = faults().on("unnamed", path);
  if (fault.error == 0 && (flags & O_DIRECT) != 0) fault = faults().on("direct", path);
  return unless_faulty<int>(fault, [&] { return real(path, flags, mode); });
}

mode_t mode_argument(int flags, va_list arguments) {
  const bool given = (flags & O_CREAT) != 0 || (flags & O_TMPFILE) == O_TMPFILE;
  return given ? va_arg(arguments, mode_t) : 0;
}

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list arguments;
  va_start(arguments, flags);
  const mode_t mode = mode_argument(flags, arguments);
  va_end(arguments);
  return faulty_open(path, flags, mode);
}

int mkostemp(char* name, int flags) {
  static const auto real = next<int (*)(char*, int)>("mkostemp");
  const Fault fault = (flags & O_DIRECT) != 0 ? faults().on("direct", name) : Fault();
  return unless_faulty<int>(fault, [&] { return real(name, flags); });
}

ssize_t read(int fd, void* to, size_t bytes) {
  static const auto real = next<ssize_t (*)(int, void*, size_t)>("read");
  const Fault fault = faults().on("read", fd);
  return unless_faulty<ssize_t>(fault,
                                [&] { return real(fd, to, std::min(bytes, fault.most_bytes)); });
}

ssize_t write(int fd, const void* from, size_t bytes) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t)>("write");
  const Fault fault = faults().on("write", fd);
  return unless_faulty<ssize_t>(fault,
                                [&] { return real(fd, from, std::min(bytes, fault.most_bytes)); });
}

ssize_t pread(int fd, void* to, size_t bytes, off_t at) {
  static const auto real = next<ssize_t (*)(int, void*, size_t, off_t)>("pread");
  const Fault fault = faults().on("pread", fd);
  return unless_faulty<ssize_t>(
      fault, [&] { return real(fd, to, std::min(bytes, fault.most_bytes), at); });
}

ssize_t pwrite(int fd, const void* from, size_t bytes, off_t at) {
  static const auto real = next<ssize_t (*)(int, const void*, size_t, off_t)>("pwrite");
  const Fault fault = faults().on("pwrite", fd);
  return unless_faulty<ssize_t>(
      fault, [&] { return real(fd, from, std::min(bytes, fault.most_bytes), at); });
}

int fsync(int fd) {
  static const auto real = next<int (*)(int)>("fsync");
  return unless_faulty<int>(faults().on("fsync", fd), [&] { return real(fd); });
}

int linkat(int from_folder, const char* from, int to_folder, const char* to, int flags) {
  static const auto real = next<int (*)(int, const char*, int, const char*, int)>("linkat");
  return unless_faulty<int>(faults().on("linkat", to),
                            [&] { return real(from_folder, from, to_folder, to, flags); });
}

int rename(const char* from, const char* to) {
  static const auto real = next<int (*)(const char*, const char*)>("rename");
  return unless_faulty<int>(faults().on("rename", to), [&] { return real(from, to); });
}

}  // extern "C"
