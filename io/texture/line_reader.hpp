#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "io/file/byte_source.hpp"

namespace atlasgauge {

/// Lines of a text, one after the other, in constant memory. A UTF-8 mark at the start is skipped.
class LineReader {
 public:
  LineReader(ByteSource& source, std::size_t max_line_bytes);

  /// Goes to the next line; false at the end.
  bool next();

  /// Without its line end. Only the first max_line_bytes are kept of a longer one.
  std::string_view line() const { return line_; }
  bool is_cut() const { return is_cut_; }
  std::uint64_t number() const { return number_; }

 private:
  bool fill();
  void append(std::string_view text);

  ByteSource& source_;
  std::size_t max_line_bytes_;
  std::array<char, 4096> buffer_{};
  std::string_view unread_;
  std::string line_;
  bool is_cut_ = false;
  std::uint64_t number_ = 0;
};

}  // namespace atlasgauge
