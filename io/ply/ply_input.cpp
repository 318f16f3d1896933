#include "io/ply/ply_input.hpp"

#include <algorithm>
#include <cstring>

#include "io/obj/obj_numbers.hpp"

namespace atlasgauge {
namespace {

std::size_t usable(std::size_t block_bytes) {
  return std::clamp(block_bytes, std::size_t{64}, std::size_t{1} << 30);
}

}  // namespace

PlyInput::PlyInput(ByteSource& source, std::size_t block_bytes)
    : source_(source),
      block_bytes_(usable(block_bytes)),
      buffer_(memory_bytes(block_bytes), '\n'),
      p_(buffer_.data()),
      end_(p_) {}

std::size_t PlyInput::memory_bytes(std::size_t block_bytes) {
  return kMaxWordBytes + usable(block_bytes) + 1 + kReadAheadBytes;
}

bool PlyInput::next_line(std::string& line, std::size_t max_bytes) {
  line.clear();
  char c = 0;
  bool is_any = false;
  while (next_byte(c)) {
    is_any = true;
    const bool may_end = line_end_ == 0 ? c == '\n' || c == '\r' : c == line_end_;
    if (!may_end) {
      if (line.size() < max_bytes) line += c;
      continue;
    }
    const bool is_pair = line_end_ == 0 && c == '\r' && bytes(1) != nullptr && *p_ == '\n';
    if (is_pair) next_byte(c);
    line_end_ = c;
    ++line_;
    break;
  }
  if (line_end_ == '\n' && !line.empty() && line.back() == '\r') line.pop_back();
  return is_any;
}

bool PlyInput::end_line() {
  bool is_blank_only = true;
  while (p_ != end_ || fill(1)) {
    if (*p_ == line_end_) break;
    is_blank_only = is_blank_only && is_word_end(*p_);
    ++p_;
  }
  return is_blank_only;
}

bool PlyInput::skip(std::uint64_t bytes) {
  while (bytes > 0) {
    if (p_ == end_ && !fill(1)) return false;
    const auto here = std::min(bytes, static_cast<std::uint64_t>(end_ - p_));
    p_ += here;
    bytes -= here;
  }
  return true;
}

void PlyInput::skip_blanks_here() {
  for (; p_ != end_; ++p_) {
    if (!is_word_end(*p_)) return;
    line_ += *p_ == line_end_ ? 1 : 0;
  }
}

const char* PlyInput::slow_word() {
  while (!source_ended_ && end_ - p_ <= static_cast<std::ptrdiff_t>(kMaxWordBytes)) {
    fill(kMaxWordBytes + 1);
    skip_blanks_here();
  }
  return p_ == end_ ? nullptr : p_;
}

bool PlyInput::fill(std::size_t bytes) {
  const auto kept = static_cast<std::size_t>(end_ - p_);
  std::memmove(buffer_.data(), p_, kept);
  p_ = buffer_.data();
  end_ = p_ + kept;
  while (!source_ended_ && static_cast<std::size_t>(end_ - p_) < bytes) read_block();
  buffer_[static_cast<std::size_t>(end_ - p_)] = '\n';
  return static_cast<std::size_t>(end_ - p_) >= bytes;
}

void PlyInput::read_block() {
  const std::size_t got = source_.read(buffer_.data() + (end_ - p_), block_bytes_);
  source_ended_ = got == 0;
  end_ += got;
  offset_ += got;
}

bool PlyInput::next_byte(char& c) {
  if (p_ == end_ && !fill(1)) return false;
  c = *p_++;
  return true;
}

}  // namespace atlasgauge
