#include "io/file/output_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

/// Closes a file descriptor.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }

 private:
  int fd_;
};

[[noreturn]] void fail(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::kResource, path, 0, "cannot write: " + what);
}

std::string folder_of(const std::string& path) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

bool is_special(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

void write_all(int fd, const std::string& path, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(fd, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, errno_text());
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

void write_directly(const std::string& path, std::string_view text) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (file.get() < 0) fail(path, errno_text());
  write_all(file.get(), path, text);
}

/// The temporary name exists only between two system calls.
void publish(const Descriptor& file, const std::string& path) {
  const std::string name = path + "." + std::to_string(::getpid()) + ".tmp";
  const std::string from = "/proc/self/fd/" + std::to_string(file.get());
  ::unlink(name.c_str());
  if (::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0) {
    fail(path, errno_text());
  }
  if (::rename(name.c_str(), path.c_str()) != 0) {
    const std::string reason = errno_text();
    ::unlink(name.c_str());
    fail(path, reason);
  }
}

/// For file systems without unnamed files.
void write_beside(const std::string& path, std::string_view text) {
  std::string name = path + ".XXXXXX";
  const Descriptor file(::mkostemp(name.data(), O_CLOEXEC));
  if (file.get() < 0) fail(path, errno_text());
  try {
    write_all(file.get(), path, text);
    ::fchmod(file.get(), 0644);
    if (::fsync(file.get()) != 0) fail(path, errno_text());
    if (::rename(name.c_str(), path.c_str()) != 0) fail(path, errno_text());
  } catch (...) {
    ::unlink(name.c_str());
    throw;
  }
}

}  // namespace

void check_writable(const std::string& path) {
  if (path == "-") return;
  if (std::filesystem::is_directory(path)) fail(path, "it is a directory; give a file name");
  if (is_special(path)) return;
  if (::access(folder_of(path).c_str(), W_OK) != 0) fail(path, errno_text());
}

void write_file(const std::string& path, std::string_view text) {
  if (path == "-") return write_all(STDOUT_FILENO, "standard output", text);
  check_writable(path);
  if (is_special(path)) return write_directly(path, text);
  const Descriptor file(::open(folder_of(path).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0644));
  if (file.get() < 0) return write_beside(path, text);
  write_all(file.get(), path, text);
  if (::fsync(file.get()) != 0) fail(path, errno_text());
  publish(file, path);
}

}  // namespace atlasgauge
