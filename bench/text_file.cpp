#include "bench/text_file.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {

TextFile::TextFile(std::string path)
    : path_(std::move(path)), file_(path_, std::ios::binary), block_(kBlockBytes) {
  check();
}

void TextFile::put(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); i += kLongestItemBytes) {
    char*& at = room();
    at += text.copy(at, kLongestItemBytes, i);
  }
}

void TextFile::put(std::uint64_t number) {
  char*& at = room();
  at = std::to_chars(at, at + kLongestItemBytes, number).ptr;
}

void TextFile::put_times(char c, std::uint64_t times) {
  while (times > 0) {
    char*& at = room();
    const auto left = static_cast<std::uint64_t>(block_.data() + kBlockBytes - at);
    const std::uint64_t count = std::min(times, left);
    std::memset(at, c, count);
    at += count;
    times -= count;
  }
}

void TextFile::close() {
  flush();
  file_.close();
  check();
}

void TextFile::flush() {
  file_.write(block_.data(), at_ - block_.data());
  check();
  at_ = block_.data();
}

void TextFile::check() const {
  if (!file_) throw Error(ErrorKind::kResource, path_, 0, errno_text());
}

}  // namespace atlasgauge
