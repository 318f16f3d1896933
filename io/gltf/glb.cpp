#include "io/gltf/glb.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <string>

#include "io/error.hpp"
#include "io/file/little_endian.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kHeaderBytes = 12;
constexpr std::uint64_t kChunkHeaderBytes = 8;
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;
constexpr std::uint32_t kBinaryChunk = 0x004E4942;

struct Chunk {
  std::uint32_t type = 0;
  ByteRange content;
};

[[noreturn]] void refuse(const ByteRange& glb, const std::string& text) {
  throw Error(ErrorKind::kInput, glb.path, 0, text);
}

void check_version(const ByteRange& glb, std::uint32_t version) {
  if (version == 2) return;
  if (version == 1) {
    refuse(glb, "found a binary glTF 1.0, expected 2.0; convert it, as with gltf-pipeline");
  }
  refuse(glb, fmt::format("found a GLB of version {}, expected 2", version));
}

/// The GLB without what may follow it, as the padding of a tile.
ByteRange trimmed_glb(const ByteRange& range) {
  const std::string header = read_begin(range, kHeaderBytes);
  if (header.size() < kHeaderBytes) refuse(range, "found a GLB that is cut off in its header");
  check_version(range, read_number<std::uint32_t>(&header[4]));
  const auto bytes = read_number<std::uint32_t>(&header[8]);
  if (bytes < kHeaderBytes || bytes > range.size) {
    refuse(range, fmt::format("its GLB header promises {} bytes, but {} are there: it is cut off",
                              bytes, range.size));
  }
  return range.part(0, bytes);
}

Chunk chunk_at(const ByteRange& glb, std::uint64_t begin) {
  if (!glb.holds(begin, kChunkHeaderBytes)) {
    refuse(glb, "found a GLB that is cut off before a chunk");
  }
  const std::string header = read_range(glb.part(begin, kChunkHeaderBytes));
  const auto bytes = read_number<std::uint32_t>(&header[0]);
  const std::uint64_t content = begin + kChunkHeaderBytes;
  if (!glb.holds(content, bytes)) {
    refuse(glb, fmt::format("a chunk of the GLB promises {} bytes, but {} are there: it is cut off",
                            bytes, glb.size - content));
  }
  return {read_number<std::uint32_t>(&header[4]), glb.part(content, bytes)};
}

/// Chunks of other types are of extensions, and skipped.
GltfChunks chunks_of_glb(const ByteRange& glb) {
  const Chunk json = chunk_at(glb, kHeaderBytes);
  if (json.type != kJsonChunk) refuse(glb, "the first chunk of the GLB is not its JSON");
  GltfChunks chunks{json.content, std::nullopt};
  std::uint64_t next = kHeaderBytes + kChunkHeaderBytes + json.content.size;
  while (next < glb.size && !chunks.binary) {
    const Chunk chunk = chunk_at(glb, next);
    if (chunk.type == kBinaryChunk) chunks.binary = chunk.content;
    next += kChunkHeaderBytes + chunk.content.size;
  }
  return chunks;
}

}  // namespace

GltfChunks find_gltf_chunks(const ByteRange& range) {
  if (read_begin(range, 4) != "glTF") return {range, std::nullopt};
  return chunks_of_glb(trimmed_glb(range));
}

}  // namespace atlasgauge
