#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/obj/obj_reader.hpp"
#include "tests/support/collect_sink.hpp"

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

/// All that an OBJ says.
struct ObjContent {
  CollectSink mesh;
  ObjSummary summary;
  std::vector<std::string> messages;
};

/// Reads a text under the name "model.obj", one block after the other.
inline ObjContent read_obj(ByteSource& source, std::size_t block_bytes = 1 << 16,
                           bool strict = false) {
  ObjContent content;
  Warnings warnings([&](const std::string& text) { content.messages.push_back(text); }, strict);
  ObjReader reader(source, "model.obj", warnings, block_bytes);
  ObjBlock block;
  while (reader.next(block)) {
    reader.parse(block);
    reader.commit(block, content.mesh);
  }
  content.summary = reader.finish();
  return content;
}

inline ObjContent read_obj(const std::string& text, std::size_t block_bytes = 1 << 16,
                           bool strict = false) {
  TextSource source(text);
  return read_obj(source, block_bytes, strict);
}

}  // namespace atlasgauge
