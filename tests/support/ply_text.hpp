#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "io/ply/ply_reader.hpp"
#include "tests/support/collect_sink.hpp"
#include "tests/support/text_source.hpp"

namespace atlasgauge {

/// All that a PLY file says.
struct PlyContent {
  CollectSink mesh;
  PartCounts counts;
  PartMaterials materials;
  std::vector<std::string> messages;
};

/// Reads all of a part.
inline PlyContent read_ply(PlyReader& reader) {
  PlyContent content;
  Warnings warnings([&](const std::string& text) { content.messages.push_back(text); });
  const std::unique_ptr<MeshPart> part = reader.next();
  content.counts = part->counts();
  content.materials = reader.materials();
  part->load();
  part->emit(content.mesh, warnings);
  return content;
}

/// Reads bytes under the name "model.ply".
inline PlyContent read_ply(const std::string& bytes, std::size_t block_bytes = 1 << 16,
                           std::size_t bytes_a_read = SIZE_MAX) {
  PlyReader reader(std::make_unique<TextSource>(bytes, bytes_a_read), "model.ply", block_bytes);
  return read_ply(reader);
}

}  // namespace atlasgauge
