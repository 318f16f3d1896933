#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/obj/obj_reader.hpp"
#include "tests/support/collect_sink.hpp"
#include "tests/support/text_source.hpp"

namespace atlasgauge {

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
