#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "io/file/byte_source.hpp"

namespace atlasgauge {

/// Bytes of a PLY file, read a block at a time: lines of its header, then words or numbers of its
/// body. Memory is that of one block, of one word before it, and of one after.
class PlyInput {
 public:
  /// Words of a body longer than this are no numbers.
  static constexpr std::size_t kMaxWordBytes = 512;

  PlyInput(ByteSource& source, std::size_t block_bytes);
  static std::size_t memory_bytes(std::size_t block_bytes);

  /// The next line of the header without its end; false at the end of the file. Lines end as the
  /// first one does: with LF, with CR LF, or with CR. Only the first `max_bytes` are kept.
  bool next_line(std::string& line, std::size_t max_bytes);

  /// Start of the next word, nullptr at the end of the file. Its end is a blank or a line end, and
  /// kReadAheadBytes after that can be read, if it has kMaxWordBytes or fewer.
  const char* word() {
    skip_blanks_here();
    if (end_ - p_ <= static_cast<std::ptrdiff_t>(kMaxWordBytes)) [[unlikely]] {
      return slow_word();
    }
    return p_;
  }

  /// `bytes` (at most kMaxWordBytes) in a row, nullptr if the file has fewer.
  const char* bytes(std::size_t bytes) {
    if (static_cast<std::size_t>(end_ - p_) < bytes && !fill(bytes)) [[unlikely]] {
      return nullptr;
    }
    return p_;
  }

  void go_to(const char* p) { p_ = p; }
  /// Goes to the end of this line; false if more than blanks stood before it.
  bool end_line();
  /// False if the file has fewer.
  bool skip(std::uint64_t bytes);

  /// Of what comes next, from 1.
  std::uint64_t line() const { return line_; }
  /// Of the next byte in the file, decompressed.
  std::uint64_t offset() const { return offset_ - static_cast<std::uint64_t>(end_ - p_); }
  bool at_end() { return bytes(1) == nullptr; }

 private:
  void skip_blanks_here();
  const char* slow_word();
  bool fill(std::size_t bytes);
  void read_block();
  bool next_byte(char& c);

  ByteSource& source_;
  std::size_t block_bytes_;
  std::vector<char> buffer_;
  const char* p_;
  const char* end_;  // a line end stands there
  bool source_ended_ = false;
  std::uint64_t offset_ = 0;  // of end_
  std::uint64_t line_ = 1;
  char line_end_ = 0;  // last byte of one, 0 before the first
};

}  // namespace atlasgauge
