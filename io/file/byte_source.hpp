#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace atlasgauge {

/// Bytes from front to back.
class ByteSource {
 public:
  virtual ~ByteSource() = default;
  /// Fills up to `bytes` bytes; returns how many, 0 only at the end. Throws Error(kInput).
  virtual std::size_t read(char* to, std::size_t bytes) = 0;
  /// Position in the file on disk (compressed bytes for a compressed one), for progress: any thread
  /// may ask while another reads.
  virtual std::uint64_t consumed_bytes() const = 0;
  /// Size of the file on disk; 0 if it has none (a pipe).
  virtual std::uint64_t file_bytes() const = 0;
  /// Whether what is read are the bytes of the file as they lie there.
  virtual bool is_plain() const { return true; }
};

/// Opens a plain, gzip'd or zstd'd file, told apart by its first bytes. Throws Error(kInput) for a
/// missing or unreadable file, or a directory.
std::unique_ptr<ByteSource> open_byte_source(const std::string& path);

/// Fills up to `bytes` bytes from `offset` of a regular file, as they lie there; returns how many.
/// Throws Error(kInput).
std::size_t read_file_at(const std::string& path, std::uint64_t offset, char* to,
                         std::size_t bytes);

}  // namespace atlasgauge
