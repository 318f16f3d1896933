#include "io/obj/obj_block_cutter.hpp"

#include <algorithm>
#include <string_view>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

/// Bytes at the end of the text of a backslash that may escape a line end: "\" or "\" CR.
std::size_t open_escape_bytes(std::string_view text) {
  if (text.ends_with('\\')) return 1;
  if (text.ends_with("\\\r")) return 2;
  return 0;
}

bool ends_line(std::string_view text, std::size_t line_end) {
  return open_escape_bytes(text.substr(0, line_end)) == 0;
}

/// Bytes up to and with the last line end that no backslash escapes; 0 if there is none.
std::size_t whole_lines_bytes(std::string_view text) {
  std::size_t line_end = text.rfind('\n');
  while (line_end != std::string_view::npos && !ends_line(text, line_end)) {
    if (line_end == 0) return 0;
    line_end = text.rfind('\n', line_end - 1);
  }
  return line_end == std::string_view::npos ? 0 : line_end + 1;
}

/// Bytes up to and with the first line end that no backslash escapes; 0 if there is none.
std::size_t first_line_bytes(std::string_view text) {
  std::size_t line_end = text.find('\n');
  while (line_end != std::string_view::npos && !ends_line(text, line_end)) {
    line_end = text.find('\n', line_end + 1);
  }
  return line_end == std::string_view::npos ? 0 : line_end + 1;
}

std::string_view view(const FixedArray<char>& text) {
  return {text.data(), text.size()};
}

}  // namespace

ObjBlockCutter::ObjBlockCutter(ByteSource& source, std::string path, std::size_t block_bytes)
    : source_(source), path_(std::move(path)), block_bytes_(block_bytes) {
  carry_.allocate(block_bytes);
}

bool ObjBlockCutter::next(ObjBlock& block) {
  block.allocate(block_bytes_);
  fill(block);
  if (block.text.size() == 0) return false;

  std::size_t bytes = in_long_line_ ? 0 : whole_lines_bytes(view(block.text));
  if (bytes == 0) bytes = cut_piece(block);
  const std::string_view rest = view(block.text).substr(bytes);
  std::ranges::copy(rest, carry_.data());
  carry_.resize(rest.size());
  block.text.resize(bytes);
  return true;
}

void ObjBlockCutter::fill(ObjBlock& block) {
  FixedArray<char>& text = block.text;
  std::ranges::copy(view(carry_), text.data());
  text.resize(carry_.size());
  carry_.resize(0);
  while (!at_end_ && text.size() < block_bytes_) {
    const std::size_t bytes = source_.read(text.data() + text.size(), block_bytes_ - text.size());
    text.resize(text.size() + bytes);
    at_end_ = bytes == 0;
    if (at_end_) end_last_line(text);
  }
  if (std::exchange(at_start_, false)) check_encoding(block);
}

void ObjBlockCutter::check_encoding(ObjBlock& block) {
  constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
  const std::string_view text = view(block.text);
  if (text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF")) {
    throw Error(ErrorKind::kInput, path_, 0,
                "the file is UTF-16 or UTF-32 text, but an OBJ model is read as ASCII or UTF-8; "
                "convert it to UTF-8");
  }
  if (!text.starts_with(kUtf8Mark)) return;
  std::ranges::copy(text.substr(kUtf8Mark.size()), block.text.data());
  block.text.resize(text.size() - kUtf8Mark.size());
}

void ObjBlockCutter::end_last_line(FixedArray<char>& text) {
  if (text.size() == 0 && in_long_line_) text.push('\n');
  while (whole_lines_bytes(view(text)) != text.size()) text.push('\n');
}

std::size_t ObjBlockCutter::cut_piece(ObjBlock& block) {
  const std::string_view text = view(block.text);
  const std::size_t line_bytes = first_line_bytes(text);
  in_long_line_ = line_bytes == 0;
  block.kind = in_long_line_ ? ObjBlock::Kind::kPiece : ObjBlock::Kind::kLastPiece;
  return in_long_line_ ? text.size() - open_escape_bytes(text) : line_bytes;
}

}  // namespace atlasgauge
