#include "io/obj/obj_reader.hpp"

#include <algorithm>
#include <utility>

#include "io/obj/obj_block_parser.hpp"

namespace atlasgauge {
namespace {

/// Offsets into a block are 32 bits wide.
std::size_t usable(std::size_t block_bytes) {
  return std::clamp(block_bytes, std::size_t{64}, std::size_t{1} << 30);
}

}  // namespace

ObjReader::ObjReader(ByteSource& source, std::string path, Warnings& warnings,
                     std::size_t block_bytes)
    : cutter_(source, path, usable(block_bytes)), committer_(std::move(path), warnings) {}

std::size_t ObjReader::memory_bytes(std::size_t block_bytes) {
  return ObjBlock::memory_bytes(usable(block_bytes));
}

bool ObjReader::next(ObjBlock& block) {
  return cutter_.next(block);
}

void ObjReader::parse(ObjBlock& block) const {
  splice_lines(block);
  if (block.kind == ObjBlock::Kind::kWholeLines) parse_lines(block);
}

void ObjReader::commit(ObjBlock& block, MeshSink& sink) {
  committer_.commit(block, sink);
}

ObjSummary ObjReader::finish() {
  return committer_.finish();
}

std::vector<std::string> ObjReader::take_mtllib_lines() {
  return committer_.take_mtllib_lines();
}

}  // namespace atlasgauge
