#include "io/file/output_target.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

std::string link_target(const std::string& path) {
  constexpr int kMostLinks = 40;  // as the kernel follows
  fs::path target = path;
  std::error_code error;
  for (int i = 0; i < kMostLinks && fs::is_symlink(target, error); ++i) {
    target = target.parent_path() / fs::read_symlink(target, error);
  }
  if (fs::is_symlink(target, error)) fail_to_write(path, "the symbolic links run in a circle");
  return target.string();
}

bool may_write(const std::string& path) {
  return ::faccessat(AT_FDCWD, path.c_str(), W_OK, AT_EACCESS) == 0;
}

void wait_until_writable(int fd) {
  pollfd waited{fd, POLLOUT, 0};
  ::poll(&waited, 1, -1);
}

}  // namespace

void fail_to_write(const std::string& path, const std::string& reason) {
  throw Error(ErrorKind::kResource, path, 0,
              "cannot write: " + reason + "; make room or give another file to write");
}

std::string output_target(const std::string& path) {
  std::string target = link_target(path);
  std::error_code error;
  if (fs::is_directory(target, error)) fail_to_write(target, "it is a directory");
  if (fs::exists(target, error) && !may_write(target)) fail_to_write(target, errno_text());
  if (!is_special(target) && !may_write(folder_of(target))) fail_to_write(target, errno_text());
  return target;
}

bool is_special(const std::string& target) {
  struct stat status {};
  return ::stat(target.c_str(), &status) == 0 && !S_ISREG(status.st_mode);
}

std::string folder_of(const std::string& path) {
  const std::string folder = fs::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

void write_all(int fd, const std::string& path, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t n = ::write(fd, bytes.data(), bytes.size());
    if (n >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(n));
    } else if (errno == EAGAIN) {
      wait_until_writable(fd);
    } else if (errno != EINTR) {
      fail_to_write(path, errno_text());
    }
  }
}

}  // namespace atlasgauge
