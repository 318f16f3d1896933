#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/file/byte_source.hpp"
#include "io/mesh_batch.hpp"
#include "io/obj/obj_block.hpp"
#include "io/obj/obj_block_cutter.hpp"
#include "io/obj/obj_committer.hpp"
#include "io/obj/obj_summary.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// Reads Wavefront OBJ in three steps, so that a driver may run the middle one on many threads:
///
///   next()    serial, in file order: fills a block with text, cut at a line end
///   parse()   const, any thread: text to values
///   commit()  serial, in file order: resolves what depends on earlier blocks (negative indices,
///             materials), warns, and hands the values to the sink
///
/// next() of one block may run beside commit() of another. A line longer than a block is handed out
/// in pieces and read in commit() word by word, whatever its length. Besides the blocks, the reader
/// holds block_bytes of text and the names of materials (at most NameRoom::kMaxBytes). All throw in
/// next() and commit(), parse() never does.
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

  /// Instead of finish(), at any time: the `mtllib` lines committed so far, as ObjSummary has them.
  std::vector<std::string> take_mtllib_lines();

 private:
  ObjBlockCutter cutter_;
  ObjCommitter committer_;
};

}  // namespace atlasgauge
