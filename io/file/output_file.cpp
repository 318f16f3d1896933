#include "io/file/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <random>
#include <system_error>

#include "io/error.hpp"
#include "io/file/descriptor.hpp"
#include "io/file/held_signals.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(ErrorKind::kResource, path, 0,
              "cannot write: " + reason + "; make room or give another file to write");
}

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// The file that a chain of symbolic links ends at, there or not.
std::string link_target(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the kernel follows
  fs::path target = path;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(target, error); ++i) {
    target = target.parent_path() / fs::read_symlink(target, error);
  }
  if (fs::is_symlink(target, error)) fail(path, "the symbolic links run in a circle");
  return target.string();
}

bool is_special(const std::string& path) {
  struct stat status {};
  return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

bool may_write(const std::string& path) {
  return ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) == 0;
}

void wait_until_writable(int fd) {
  pollfd waited{fd, POLLOUT, 0};
  ::poll(&waited, 1, -1);
}

void write_all(int fd, const std::string& path, std::string_view text) {
  while (!text.empty()) {
    const ssize_t n = ::write(fd, text.data(), text.size());
    if (n >= 0) {
      text.remove_prefix(static_cast<std::size_t>(n));
    } else if (errno == EAGAIN) {
      wait_until_writable(fd);
    } else if (errno != EINTR) {
      fail(path, errno_text());
    }
  }
}

void write_directly(const std::string& path, std::string_view text) {
  const Descriptor file(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
  if (!file) fail(path, errno_text());
  write_all(file.get(), path, text);
}

void keep_owner_and_permissions(const Descriptor& file, const std::string& older) {
  struct stat status {};
  if (::stat(older.c_str(), &status) != 0) return;
  // Only root may give a file away; others replace what is theirs.
  [[maybe_unused]] const int refused = ::fchown(file.get(), status.st_uid, status.st_gid);
  ::fchmod(file.get(), status.st_mode & 0777);
}

void fill(const Descriptor& file, const std::string& path, std::string_view text) {
  keep_owner_and_permissions(file, path);
  write_all(file.get(), path, text);
  if (::fsync(file.get()) != 0) fail(path, errno_text());
}

/// The name that a new file has in the folder of `path` until it is renamed over `path`. Goes, with
/// the file, unless that succeeds.
class PassingName {
 public:
  explicit PassingName(const std::string& path) : path_(path) {
    std::random_device random;
    name_ = fmt::format("{}/.atlasgauge-{:08x}{:08x}", folder_of(path), random(), random());
  }
  ~PassingName() {
    if (!renamed_) ::unlink(name_.c_str());
  }
  PassingName(const PassingName&) = delete;
  PassingName& operator=(const PassingName&) = delete;

  const char* c_str() const { return name_.c_str(); }

  void rename_over_path() {
    if (::rename(name_.c_str(), path_.c_str()) != 0) fail(path_, errno_text());
    renamed_ = true;
  }

 private:
  const std::string path_;
  std::string name_;
  bool renamed_ = false;
};

/// The file has a name between two system calls only. False where the file system has no files
/// without a name, or there is no /proc to give them one.
bool write_unnamed(const std::string& path, std::string_view text) {
  const Descriptor file(::open(folder_of(path).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0666));
  if (!file) return false;
  fill(file, path, text);
  const std::string from = fmt::format("/proc/self/fd/{}", file.get());
  PassingName name(path);
  if (::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0) {
    return false;
  }
  name.rename_over_path();
  return true;
}

void write_named(const std::string& path, std::string_view text) {
  PassingName name(path);
  const Descriptor file(::open(name.c_str(), O_CREAT | O_EXCL | O_WRONLY | O_CLOEXEC, 0666));
  if (!file) fail(path, errno_text());
  fill(file, path, text);
  name.rename_over_path();
}

void check_target(const std::string& target) {
  std::error_code error;
  if (fs::is_directory(target, error)) fail(target, "it is a directory");
  if (fs::exists(target, error) && !may_write(target)) fail(target, errno_text());
  if (!is_special(target) && !may_write(folder_of(target))) fail(target, errno_text());
}

}  // namespace

void check_writable(const std::string& path) {
  if (path != "-") check_target(link_target(path));
}

void write_file(const std::string& path, std::string_view text) {
  if (path == "-") return write_all(STDOUT_FILENO, "standard output", text);
  const std::string target = link_target(path);
  check_target(target);
  if (is_special(target)) return write_directly(target, text);
  const HeldSignals held;
  if (!write_unnamed(target, text)) write_named(target, text);
}

}  // namespace atlasgauge
