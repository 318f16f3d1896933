#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

#include "io/file/descriptor.hpp"

namespace atlasgauge {

/// A stretch of a file, or bytes in memory.
struct ByteRange {
  std::string path;  ///< of the file; for bytes in memory, of the file that messages blame
  std::uint64_t offset = 0;
  std::uint64_t size = 0;
  std::shared_ptr<const std::string> content;  ///< of `offset` 0, or null

  /// Whether `bytes` bytes from `begin` lie within.
  bool holds(std::uint64_t begin, std::uint64_t bytes) const {
    return begin <= size && bytes <= size - begin;
  }
  /// A stretch of it that it holds.
  ByteRange part(std::uint64_t begin, std::uint64_t bytes) const {
    return {path, offset + begin, bytes, content};
  }
};

/// All of a regular file. Throws Error(kInput) for one that is missing, or none.
ByteRange whole_file(const std::string& path);

/// Bytes in memory. `path` is for messages.
ByteRange bytes_in_memory(std::string bytes, const std::string& path);

/// Reads from a range, in any order; a file stays open as long as it lives.
class RangeReader {
 public:
  /// Throws Error(kInput) for a file that cannot be opened.
  explicit RangeReader(ByteRange range);

  /// `begin` counts from that of the range. Throws Error(kInput) where the file has become shorter
  /// or cannot be read, and for what the range does not hold.
  void read(std::uint64_t begin, char* to, std::size_t bytes) const;

 private:
  ByteRange range_;
  Descriptor file_;
};

/// All bytes of a range, which must fit in memory. Throws Error(kInput).
std::string read_range(const ByteRange& range);

/// At most the first `bytes` bytes of a range. Throws Error(kInput).
std::string read_begin(const ByteRange& range, std::size_t bytes);

}  // namespace atlasgauge
