#include "io/image/image_file.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <vector>

#include "io/error.hpp"
#include "io/file/byte_range.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kPieceBytes = std::uint64_t{64} << 10;

}  // namespace

ImageFile::ImageFile(const ImageSource& source) : path_(source.path) {
  if (source.is_whole_file()) return;
  copy_ = Descriptor(::memfd_create("image", MFD_CLOEXEC));
  if (copy_.get() < 0) {
    throw Error(ErrorKind::kResource, source.path, 0,
                "no memory for an image within the file: " + errno_text());
  }
  if (source.content != nullptr) {
    append(source.content->data(), source.content->size());
  } else {
    take_range(source);
  }
  path_ = fmt::format("/proc/self/fd/{}", copy_.get());
}

void ImageFile::take_range(const ImageSource& source) {
  const ByteRange file = whole_file(source.path);
  if (!file.holds(source.offset, source.byte_size)) {
    throw Error(ErrorKind::kInput, source.path, 0,
                fmt::format("the file ends within an image: {} bytes from byte {} on",
                            source.byte_size, source.offset));
  }
  const RangeReader range(file.part(source.offset, source.byte_size));
  std::vector<char> piece(std::min(kPieceBytes, source.byte_size));
  while (copied_bytes_ < source.byte_size) {
    const std::size_t bytes =
        std::min<std::uint64_t>(piece.size(), source.byte_size - copied_bytes_);
    range.read(copied_bytes_, piece.data(), bytes);
    append(piece.data(), bytes);
  }
}

void ImageFile::append(const char* bytes, std::size_t size) {
  copied_bytes_ += size;
  while (size > 0) {
    const ::ssize_t written = ::write(copy_.get(), bytes, size);
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) {
      throw Error(ErrorKind::kResource, "no memory for an image within a file: " + errno_text());
    }
    bytes += written;
    size -= static_cast<std::size_t>(written);
  }
}

}  // namespace atlasgauge
