#include "io/corpus/input_digest.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <ctime>
#include <filesystem>
#include <optional>
#include <string_view>
#include <utility>

#include "io/corpus/xxh3_hash.hpp"
#include "io/file/descriptor.hpp"
#include "io/file/file_path.hpp"

namespace atlasgauge {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kBufferBytes = std::size_t{1} << 20;
/// Of a file that changes while it is read.
constexpr int kMostReadings = 4;

/// A regular file that can be read, or nothing. A pipe or device is never opened: that might wait,
/// or do something.
Descriptor open_regular(const std::string& path) {
  struct stat status {};
  if (::stat(path.c_str(), &status) != 0 || !S_ISREG(status.st_mode)) return {};
  return Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
}

/// A time beyond the year 2262 wraps around.
std::int64_t nanoseconds(const ::timespec& time) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  return static_cast<std::int64_t>(static_cast<std::uint64_t>(time.tv_sec) * kSecond +
                                   static_cast<std::uint64_t>(time.tv_nsec));
}

/// Missing also where another kind of file has taken the place.
InputFile state_of(const Descriptor& file, const std::string& path) {
  struct stat status {};
  if (!file || ::fstat(file.get(), &status) != 0 || !S_ISREG(status.st_mode)) return {.path = path};
  return {path, static_cast<std::uint64_t>(status.st_size), nanoseconds(status.st_mtim)};
}

/// Up to `bytes` bytes from the start of a file; nothing where it cannot be read. A file that grows
/// all the time has an end here.
std::optional<Xxh3Hash> hash_of(const Descriptor& file, std::uint64_t bytes, std::string& buffer) {
  Xxh3Hash hash;
  std::uint64_t done = 0;
  while (done < bytes) {
    const std::uint64_t wanted = std::min<std::uint64_t>(bytes - done, buffer.size());
    const ssize_t got = ::pread(file.get(), buffer.data(), wanted, static_cast<off_t>(done));
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return std::nullopt;
    if (got == 0) break;
    hash.add({buffer.data(), static_cast<std::size_t>(got)});
    done += static_cast<std::uint64_t>(got);
  }
  return hash;
}

/// A file as it was read, and the hash of what was read.
struct ReadFile {
  InputFile state;
  Xxh3Hash content;
};

ReadFile read_once(const std::string& path, std::string& buffer, bool& is_settled) {
  const Descriptor file = open_regular(path);
  const InputFile before = state_of(file, path);
  is_settled = true;
  if (before.modified_ns == InputFile::kMissing) return {before, {}};
  std::optional<Xxh3Hash> content = hash_of(file, before.bytes, buffer);
  if (!content) return {{.path = path}, {}};
  is_settled = state_of(file, path) == before;
  return {before, std::move(*content)};
}

ReadFile read_settled(const std::string& path, std::string& buffer) {
  bool is_settled = false;
  ReadFile read = read_once(path, buffer, is_settled);
  for (int readings = 1; !is_settled && readings < kMostReadings; ++readings) {
    read = read_once(path, buffer, is_settled);
  }
  return read;
}

fs::path lexically_absolute(const fs::path& path) {
  return fs::absolute(path.empty() ? "." : path).lexically_normal();
}

bool leaves(const fs::path& relative) {
  return relative.empty() || *relative.begin() == "..";
}

/// Images come in the one spelling of a file, without symbolic links, so that a root that is
/// reached through some may seem to be elsewhere.
std::string name_in(const std::string& root, const std::string& path) {
  const fs::path as_spelled = lexically_absolute(path).lexically_relative(lexically_absolute(root));
  if (!leaves(as_spelled)) return as_spelled.generic_string();
  const fs::path resolved = fs::path(one_spelling(lexically_absolute(path)))
                                .lexically_relative(one_spelling(lexically_absolute(root)));
  return (leaves(resolved) ? as_spelled : resolved).generic_string();
}

void add_number(std::uint64_t number, Xxh3Hash& hash) {
  std::string bytes;
  for (int shift = 0; shift < 64; shift += 8) bytes += static_cast<char>(number >> shift & 0xFF);
  hash.add(bytes);
}

void add_file(const std::string& name, const ReadFile& file, Xxh3Hash& hash) {
  const bool exists = file.state.modified_ns != InputFile::kMissing;
  const auto content = file.content.bytes();
  add_number(name.size(), hash);
  hash.add(name);
  hash.add(exists ? "+" : "-");
  add_number(file.state.bytes, hash);
  hash.add({reinterpret_cast<const char*>(content.data()), content.size()});
}

}  // namespace

InputDigest digest_inputs(const std::string& root, const std::vector<std::string>& files) {
  InputDigest digest;
  Xxh3Hash hash;
  std::string buffer(kBufferBytes, '\0');
  for (const std::string& path : files) {
    ReadFile file = read_settled(path, buffer);
    add_file(name_in(root, path), file, hash);
    digest.bytes += file.state.bytes;
    digest.files.push_back(std::move(file.state));
  }
  digest.hex = hash.hex();
  return digest;
}

bool unchanged(const std::vector<InputFile>& files) {
  return !files.empty() && std::ranges::all_of(files, [](const InputFile& file) {
    return state_of(open_regular(file.path), file.path) == file;
  });
}

}  // namespace atlasgauge
