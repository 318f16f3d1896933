#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace atlasgauge {

/// A file as it was when it was digested. A missing or unreadable one has bytes == 0 and
/// modified_ns == kMissing; so has what is no regular file.
struct InputFile {
  static constexpr std::int64_t kMissing = std::numeric_limits<std::int64_t>::min();

  std::string path;
  std::uint64_t bytes = 0;
  std::int64_t modified_ns = kMissing;  ///< since 1970

  bool operator==(const InputFile&) const = default;
};

/// What tells the inputs of a model apart from all others.
struct InputDigest {
  std::string hex;          ///< 32 digits
  std::uint64_t bytes = 0;  ///< of all files
  std::vector<InputFile> files;
};

/// XXH3-128 over, for each file in order: its name (the path relative to `root`) behind its length,
/// whether it is there, its size, and the XXH3-128 of its content; numbers little-endian. However
/// `root` and the files are spelled, and wherever they lie together, it is the same. Reads in
/// constant memory; a file that changes meanwhile is read again a few times, and then keeps the
/// time from before it was read, so that unchanged() tells.
InputDigest digest_inputs(const std::string& root, const std::vector<std::string>& files);

/// Whether there are files, and every one still has the size and time of modification that it had:
/// what lets a job trust a digest without reading it all again.
bool unchanged(const std::vector<InputFile>& files);

}  // namespace atlasgauge
