#pragma once

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>

namespace atlasgauge {

/// Bytes at the beginning of a file, for scans of headers. Behind the end they are zero and `ended`
/// is true.
class HeaderBytes {
 public:
  explicit HeaderBytes(const std::string& path) : file_(path, std::ios::binary) {}

  bool ended() const { return !file_.good(); }
  std::uint64_t file_bytes();
  void seek(std::uint64_t offset) { file_.seekg(static_cast<std::streamoff>(offset)); }
  std::uint64_t offset() { return static_cast<std::uint64_t>(file_.tellg()); }

  std::uint8_t byte();
  std::uint32_t big_endian(int bytes);
  std::uint32_t little_endian(int bytes);
  std::string text(std::size_t bytes);
  /// Up to a zero byte, or `most` bytes.
  std::string text_to_zero(std::size_t most);

 private:
  std::ifstream file_;
};

}  // namespace atlasgauge
