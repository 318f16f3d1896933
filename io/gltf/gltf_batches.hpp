#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/mesh_batch.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// Gathers the values of one part into batches, in their order: positions, texture coordinates,
/// faces. Counts what is odd, and warns of it at the end.
class GltfBatches {
 public:
  /// A batch has at most `batch_elements` values.
  GltfBatches(MeshSink& sink, std::size_t batch_elements);

  void add(const Position& position);
  void add(const TexCoord& texcoord);
  /// Drops a face that names a position which was not added; a texture coordinate that was not
  /// added is none.
  void add(FaceRecord face);
  void add_invalid_polygon() { ++invalid_; }

  /// Hands out what is left, and warns. `path` and `part` are for messages.
  void finish(Warnings& warnings, const std::string& path, const std::string& part);

  /// What a batch takes at most.
  static std::uint64_t memory_bytes(std::size_t batch_elements);

 private:
  void flush();
  void flush_if_full(std::size_t gathered);

  MeshSink& sink_;
  std::size_t batch_elements_;
  std::vector<Position> positions_;
  std::vector<TexCoord> texcoords_;
  std::vector<FaceRecord> faces_;
  std::uint64_t position_count_ = 0;
  std::uint64_t texcoord_count_ = 0;
  std::uint64_t invalid_ = 0;
  std::uint64_t not_finite_ = 0;
};

}  // namespace atlasgauge
