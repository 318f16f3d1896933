#include "io/file/output_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw Error(ErrorKind::kResource, path, 0,
              "cannot write into this folder: " + reason + "; give another folder");
}

}  // namespace

void make_output_folder(const std::string& path) {
  if (::mkdir(path.c_str(), 0777) == 0) return;
  if (errno == ENOENT) fail(path, "the folder that it would lie in does not exist");
  if (errno != EEXIST) fail(path, errno_text());
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) fail(path, "it is something else than a folder");
  if (::faccessat(AT_FDCWD, path.c_str(), W_OK | X_OK, AT_EACCESS) != 0) fail(path, errno_text());
}

}  // namespace atlasgauge
