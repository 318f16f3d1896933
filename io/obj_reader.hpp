#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "io/byte_source.hpp"
#include "io/mesh_batch.hpp"
#include "io/obj_block.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// What an OBJ says besides geometry.
struct ObjSummary {
  std::vector<std::string> material_names;   ///< by MaterialId, in order of first `usemtl`
  std::vector<std::string> mtllib_lines;     ///< the rest of every `mtllib` line, trimmed
  std::uint64_t positions = 0;
  std::uint64_t texcoords = 0;
  std::uint64_t faces = 0;                   ///< triangles handed to the sink
  std::uint64_t invalid_polygons = 0;        ///< dropped already; ForwardPolygons not included
  std::uint64_t skipped_primitives = 0;      ///< `l`, `p`, curves and surfaces
  std::uint64_t unknown_statements = 0;
};

/// Reads Wavefront OBJ in three steps, so that a driver may run the middle one on many threads:
///
///   next()    serial, in file order: fills a block with text, cut at a line end
///   parse()   const, any thread: text to values
///   commit()  serial, in file order: resolves what depends on earlier blocks (negative indices,
///             materials), warns, and hands the values to the sink
///
/// A line longer than a block is handled inside next()/commit() word by word, whatever its length.
/// Throws Error(kInput) with file and line for statements whose numbers cannot be read.
class ObjReader {
 public:
  /// `block_bytes` of text are read at a time (at least 64).
  ObjReader(ByteSource& source, std::string path, Warnings& warnings, std::size_t block_bytes);

  /// Bytes that one ObjBlock may grow to, in the worst case.
  static std::size_t memory_bytes(std::size_t block_bytes);

  bool next(ObjBlock& block);
  void parse(ObjBlock& block) const;
  void commit(ObjBlock& block, MeshSink& sink);

  /// After the last commit().
  ObjSummary finish();
};

}  // namespace atlasgauge
