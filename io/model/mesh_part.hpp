#pragma once

#include <cstdint>
#include <optional>

#include "io/mesh_batch.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// Elements of a part, as its header promises them; faces are triangles where that is known, else
/// polygons.
struct PartCounts {
  std::uint64_t positions = 0;
  std::uint64_t texcoords = 0;
  std::uint64_t faces = 0;
};

/// How finely an input has rounded its values.
struct Quantization {
  std::uint32_t position_bits = 0;  ///< 0: positions are not quantized
  double position_step = 0;         ///< model units, of the coarsest axis, transforms applied
  std::uint32_t uv_bits = 0;        ///< 0: texture coordinates are not quantized
  double uv_step = 0;               ///< UV units, of the coarser axis
};

/// A stretch of a model with an index base of its own: a PLY file, a Draco stream, a primitive of a
/// glTF under one node. Indices in its batches are relative to the part; materials are those of the
/// reader it comes from. Read in two steps, so that a driver may run the first on many threads:
///
///   load()  any thread: what must be in memory at once (a Draco stream)
///   emit()  serial, in order of the parts: hands out all values, in batches
///
/// Both throw Error(kInput) with the file's path; load() never warns.
class MeshPart {
 public:
  virtual ~MeshPart() = default;

  virtual PartCounts counts() const = 0;
  /// Peak of what load() and emit() allocate, from the header. The caller reserves it first.
  virtual std::uint64_t memory_bytes() const = 0;
  virtual void load() {}
  virtual void emit(MeshSink& sink, Warnings& warnings) = 0;
  /// After load().
  virtual std::optional<Quantization> quantization() const { return std::nullopt; }
};

}  // namespace atlasgauge
