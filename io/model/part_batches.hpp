#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/mesh_batch.hpp"
#include "io/model/value_warnings.hpp"

namespace atlasgauge {

/// Collects values into batches of a fixed size for a sink, and counts them.
class PartBatches {
 public:
  static constexpr std::size_t kBatch = 4096;
  static constexpr std::size_t kMemoryBytes =
      kBatch * (sizeof(Position) + sizeof(TexCoord) + sizeof(FaceRecord));

  PartBatches(const std::string& path, MeshSink& sink, Warnings& warnings);

  std::uint64_t texcoords() const { return texcoords_before_ + texcoords_.size(); }
  std::uint64_t faces() const { return faces_before_ + faces_.size(); }

  void add(const Position& position, std::uint64_t line) {
    values_.check(position, line);
    positions_.push_back(position);
    if (positions_.size() == kBatch) flush();
  }
  void add(const TexCoord& texcoord, std::uint64_t line) {
    values_.check(texcoord, line);
    texcoords_.push_back(texcoord);
    if (texcoords_.size() == kBatch) flush();
  }
  void add(const FaceRecord& face) {
    faces_.push_back(face);
    if (faces_.size() == kBatch) flush();
  }

  /// A polygon that nothing was added of.
  void drop_polygon(const char* why, std::uint64_t line);
  /// The last `faces` faces, of one polygon that turned out to be invalid.
  void withdraw_polygon(std::uint64_t faces, std::uint64_t line);
  /// Hands out what is left.
  void finish();

 private:
  void flush();

  const std::string& path_;
  MeshSink& sink_;
  ValueWarnings values_;
  std::vector<Position> positions_;
  std::vector<TexCoord> texcoords_;
  std::vector<FaceRecord> faces_;
  std::uint64_t invalid_polygons_ = 0;
  std::uint64_t positions_before_ = 0;
  std::uint64_t texcoords_before_ = 0;
  std::uint64_t faces_before_ = 0;
};

}  // namespace atlasgauge
