#include "io/file/byte_range.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {

ByteRange whole_file(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0) {
    throw Error(ErrorKind::kInput, path, 0, "cannot open: " + errno_text());
  }
  if (!S_ISREG(status.st_mode)) {
    throw Error(ErrorKind::kInput, path, 0,
                "found a folder, pipe or device where a regular file is expected");
  }
  return {path, 0, static_cast<std::uint64_t>(status.st_size), nullptr};
}

ByteRange bytes_in_memory(std::string bytes, const std::string& path) {
  const std::uint64_t size = bytes.size();
  return {path, 0, size, std::make_shared<const std::string>(std::move(bytes))};
}

RangeReader::RangeReader(ByteRange range) : range_(std::move(range)) {
  if (range_.content != nullptr) return;
  file_ = Descriptor(::open(range_.path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file_) throw Error(ErrorKind::kInput, range_.path, 0, "cannot open: " + errno_text());
}

void RangeReader::read(std::uint64_t begin, char* to, std::size_t bytes) const {
  if (!range_.holds(begin, bytes)) {
    throw Error(ErrorKind::kInput, range_.path, 0,
                fmt::format("found {} bytes where bytes {} to {} are needed: the file is cut off",
                            range_.size, begin, begin + bytes));
  }
  if (range_.content != nullptr) {
    std::memcpy(to, range_.content->data() + range_.offset + begin, bytes);
    return;
  }
  std::size_t done = 0;
  while (done < bytes) {
    const auto at = static_cast<off_t>(range_.offset + begin + done);
    const ssize_t got = ::pread(file_.get(), to + done, bytes - done, at);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw Error(ErrorKind::kInput, range_.path, 0, "cannot read: " + errno_text());
    if (got == 0) {
      throw Error(ErrorKind::kInput, range_.path, 0,
                  "it has become shorter since it was opened: measure it again when nothing "
                  "writes it");
    }
    done += static_cast<std::size_t>(got);
  }
}

std::string read_range(const ByteRange& range) {
  return read_begin(range, range.size);
}

std::string read_begin(const ByteRange& range, std::size_t bytes) {
  std::string text(std::min<std::uint64_t>(bytes, range.size), '\0');
  RangeReader(range).read(0, text.data(), text.size());
  return text;
}

}  // namespace atlasgauge
