#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include "io/file/byte_source.hpp"

namespace atlasgauge {

/// A text as a file, handed out a few bytes at a time.
class TextSource : public ByteSource {
 public:
  explicit TextSource(std::string text, std::size_t bytes_a_read = SIZE_MAX)
      : text_(std::move(text)), bytes_a_read_(bytes_a_read) {}

  std::size_t read(char* to, std::size_t bytes) override {
    const std::size_t got = text_.copy(to, std::min(bytes, bytes_a_read_), read_);
    read_ += got;
    return got;
  }
  std::uint64_t consumed_bytes() const override { return read_; }
  std::uint64_t file_bytes() const override { return text_.size(); }

 private:
  std::string text_;
  std::size_t bytes_a_read_;
  std::size_t read_ = 0;
};

}  // namespace atlasgauge
