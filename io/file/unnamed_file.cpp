#include "io/file/unnamed_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <random>

#include "io/error.hpp"
#include "io/file/held_signals.hpp"
#include "io/file/output_target.hpp"

namespace atlasgauge {
namespace {

/// The name that a file has in the folder of `path` until it is renamed over `path`. Goes, with the
/// file, unless that succeeds.
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

  Descriptor create(mode_t mode) const {
    Descriptor file(::open(c_str(), O_CREAT | O_EXCL | O_RDWR | O_CLOEXEC, mode));
    if (!file) fail_to_write(path_, errno_text());
    return file;
  }

  void rename_over_path() {
    if (::rename(name_.c_str(), path_.c_str()) != 0) fail_to_write(path_, errno_text());
    renamed_ = true;
  }

 private:
  const std::string path_;
  std::string name_;
  bool renamed_ = false;
};

/// Fails where the file system has no files without a name.
Descriptor open_unnamed(const std::string& target) {
  return Descriptor(::open(folder_of(target).c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0666));
}

Descriptor create_and_unlink(const std::string& target) {
  const HeldSignals held;
  return PassingName(target).create(0600);
}

void keep_owner_and_permissions(const Descriptor& file, const std::string& older) {
  struct stat status {};
  if (::stat(older.c_str(), &status) != 0) return;
  // Only root may give a file away; others replace what is theirs.
  [[maybe_unused]] const int refused = ::fchown(file.get(), status.st_uid, status.st_gid);
  ::fchmod(file.get(), status.st_mode & 0777);
}

void flush_to_disk(const Descriptor& file, const std::string& target) {
  if (::fsync(file.get()) != 0) fail_to_write(target, errno_text());
}

}  // namespace

UnnamedFile::UnnamedFile(const std::string& path) : target_(output_target(path)) {
  if (is_special(target_)) fail_to_write(target_, "it is a pipe or a device");
  file_ = open_unnamed(target_);
  if (file_) return;
  file_ = create_and_unlink(target_);
  can_be_linked_ = false;
}

void UnnamedFile::append(std::string_view bytes) {
  write_all(file_.get(), target_, bytes);
}

void UnnamedFile::write_at(std::uint64_t offset, std::string_view bytes) const {
  while (!bytes.empty()) {
    const ssize_t n = ::pwrite(file_.get(), bytes.data(), bytes.size(), static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_to_write(target_, errno_text());
    bytes.remove_prefix(static_cast<std::size_t>(n));
    offset += static_cast<std::uint64_t>(n);
  }
}

void UnnamedFile::commit() {
  if (!can_be_linked_ || !link_over_target()) copy_over_target();
  file_ = Descriptor();
}

/// The file has a passing name between two system calls only. False where the file system does not
/// give names to files, or there is no /proc to ask through.
bool UnnamedFile::link_over_target() const {
  keep_owner_and_permissions(file_, target_);
  flush_to_disk(file_, target_);
  const std::string from = fmt::format("/proc/self/fd/{}", file_.get());
  const HeldSignals held;
  PassingName name(target_);
  if (::linkat(AT_FDCWD, from.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) != 0) {
    return false;
  }
  name.rename_over_path();
  return true;
}

void UnnamedFile::copy_over_target() const {
  const HeldSignals held;
  PassingName name(target_);
  const Descriptor copy = name.create(0666);
  keep_owner_and_permissions(copy, target_);
  std::array<char, 64 << 10> block;
  for (off_t done = 0;;) {
    const ssize_t n = ::pread(file_.get(), block.data(), block.size(), done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_to_write(target_, errno_text());
    if (n == 0) break;
    write_all(copy.get(), target_, {block.data(), static_cast<std::size_t>(n)});
    done += n;
    if (held.end_awaits()) fail_to_write(target_, "the program was asked to end");
  }
  flush_to_disk(copy, target_);
  name.rename_over_path();
}

}  // namespace atlasgauge
