#include "io/file/byte_source.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/iostreams/categories.hpp>
#include <boost/iostreams/filter/gzip.hpp>
#include <boost/iostreams/filter/zstd.hpp>
#include <cerrno>
#include <ios>
#include <string_view>
#include <utility>

#include "io/error.hpp"
#include "io/file/descriptor.hpp"
#include "io/file/zstd_frames.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kMagicBytes = 4;
constexpr std::streamsize kCompressedBytes = 256 << 10;

/// A file as it lies on disk. Its first bytes can be looked at before they are read, which works
/// for pipes too.
class PlainSource : public ByteSource {
 public:
  explicit PlainSource(const std::string& path)
      : path_(path), file_(::open(path.c_str(), O_RDONLY | O_CLOEXEC)) {
    if (!file_) fail("cannot open: " + errno_text());
    const struct stat status = status_now();
    if (S_ISDIR(status.st_mode)) fail("found a directory where a file is expected");
    if (S_ISREG(status.st_mode)) file_bytes_ = static_cast<std::uint64_t>(status.st_size);
    while (magic_bytes_ < kMagicBytes) {
      const std::size_t bytes = read_file(magic_.data() + magic_bytes_, kMagicBytes - magic_bytes_);
      if (bytes == 0) break;
      magic_bytes_ += bytes;
    }
  }

  std::string_view magic() const { return {magic_.data(), magic_bytes_}; }

  std::size_t read(char* to, std::size_t bytes) override {
    const std::size_t unread = magic_bytes_ - static_cast<std::size_t>(std::min<std::uint64_t>(
                                                  consumed_bytes_, magic_bytes_));
    const std::size_t got =
        unread == 0 ? read_file(to, bytes) : magic().substr(magic_bytes_ - unread).copy(to, bytes);
    consumed_bytes_ += got;
    return got;
  }

  std::uint64_t consumed_bytes() const override { return consumed_bytes_; }
  std::uint64_t file_bytes() const override { return file_bytes_; }

 private:
  std::size_t read_file(char* to, std::size_t bytes) {
    for (;;) {
      const ssize_t got = ::read(file_.get(), to, bytes);
      if (got == 0 && bytes > 0) check_size_kept();
      if (got >= 0) {
        read_bytes_ += static_cast<std::uint64_t>(got);
        return static_cast<std::size_t>(got);
      }
      if (errno != EINTR) fail("cannot read: " + errno_text());
    }
  }

  struct stat status_now() const {
    struct stat status {};
    if (::fstat(file_.get(), &status) != 0) fail("cannot read: " + errno_text());
    return status;
  }

  /// At its end: what was read is no model if someone was writing it.
  void check_size_kept() const {
    const struct stat status = status_now();
    if (!S_ISREG(status.st_mode)) return;
    const auto bytes_now = static_cast<std::uint64_t>(status.st_size);
    if (bytes_now == file_bytes_ && read_bytes_ >= file_bytes_) return;
    fail("it had " + std::to_string(file_bytes_) + " bytes when opened, but ended after " +
         std::to_string(read_bytes_) +
         ": it changes while it is read; measure it again when nothing writes it");
  }

  [[noreturn]] void fail(const std::string& text) const {
    throw Error(ErrorKind::kInput, path_, 0, text);
  }

  std::string path_;
  Descriptor file_;
  std::array<char, kMagicBytes> magic_{};
  std::size_t magic_bytes_ = 0;
  std::atomic<std::uint64_t> consumed_bytes_ = 0;  // with the magic bytes once they are handed out
  std::uint64_t read_bytes_ = 0;
  std::uint64_t file_bytes_ = 0;
};

/// What a decompressor reads from.
class CompressedDevice {
 public:
  using char_type = char;
  using category = boost::iostreams::source_tag;

  CompressedDevice(PlainSource& file, ZstdFrames* frames) : file_(&file), frames_(frames) {}

  std::streamsize read(char* to, std::streamsize bytes) {
    const std::size_t got = file_->read(to, static_cast<std::size_t>(bytes));
    if (got == 0) return -1;
    if (frames_ != nullptr) frames_->add({to, got});
    return static_cast<std::streamsize>(got);
  }

 private:
  PlainSource* file_;
  ZstdFrames* frames_;
};

template <class Decompressor>
class CompressedSource : public ByteSource {
 public:
  CompressedSource(std::string path, std::unique_ptr<PlainSource> file, Decompressor decompressor)
      : path_(std::move(path)),
        file_(std::move(file)),
        device_(*file_, kIsZstd ? &frames_ : nullptr),
        decompressor_(std::move(decompressor)) {}

  std::size_t read(char* to, std::size_t bytes) override {
    if (at_end_) return 0;
    try {
      const std::streamsize got =
          decompressor_.read(device_, to, static_cast<std::streamsize>(bytes));
      if (got > 0) return static_cast<std::size_t>(got);
    } catch (const std::ios_base::failure&) {
      throw Error(ErrorKind::kInput, path_, 0, broken_text());
    }
    at_end_ = true;
    if (!frames_.complete()) throw Error(ErrorKind::kInput, path_, 0, broken_text());
    return 0;
  }

  std::uint64_t consumed_bytes() const override { return file_->consumed_bytes(); }
  std::uint64_t file_bytes() const override { return file_->file_bytes(); }
  bool is_plain() const override { return false; }

 private:
  static constexpr bool kIsZstd = std::is_same_v<Decompressor, boost::iostreams::zstd_decompressor>;

  static std::string broken_text() {
    return std::string("the ") + (kIsZstd ? "zstd" : "gzip") +
           " data is cut off or damaged; compress the model again";
  }

  std::string path_;
  std::unique_ptr<PlainSource> file_;
  ZstdFrames frames_;
  CompressedDevice device_;
  Decompressor decompressor_;
  bool at_end_ = false;
};

}  // namespace

std::unique_ptr<ByteSource> open_byte_source(const std::string& path) {
  namespace bio = boost::iostreams;
  auto file = std::make_unique<PlainSource>(path);
  if (file->magic().starts_with("\x1F\x8B")) {
    return std::make_unique<CompressedSource<bio::gzip_decompressor>>(
        path, std::move(file),
        bio::gzip_decompressor(bio::gzip::default_window_bits, kCompressedBytes));
  }
  if (ZstdFrames::is_magic(file->magic())) {
    return std::make_unique<CompressedSource<bio::zstd_decompressor>>(
        path, std::move(file), bio::zstd_decompressor(kCompressedBytes));
  }
  return file;
}

std::size_t read_file_at(const std::string& path, std::uint64_t offset, char* to,
                         std::size_t bytes) {
  const Descriptor file(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!file) throw Error(ErrorKind::kInput, path, 0, "cannot open: " + errno_text());
  std::size_t done = 0;
  while (done < bytes) {
    const ssize_t got =
        ::pread(file.get(), to + done, bytes - done, static_cast<off_t>(offset + done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw Error(ErrorKind::kInput, path, 0, "cannot read: " + errno_text());
    if (got == 0) break;
    done += static_cast<std::size_t>(got);
  }
  return done;
}

}  // namespace atlasgauge
