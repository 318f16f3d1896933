#pragma once

#include <cstddef>
#include <string>

#include "io/file/byte_source.hpp"
#include "io/obj/fixed_array.hpp"
#include "io/obj/obj_block.hpp"

namespace atlasgauge {

/// Cuts a stream of text into blocks at line ends, and lines longer than a block into pieces. A
/// line that a backslash continues is one line. A missing final line end is added.
class ObjBlockCutter {
 public:
  ObjBlockCutter(ByteSource& source, std::string path, std::size_t block_bytes);

  /// Fills the text of a block; false at the end of the file.
  bool next(ObjBlock& block);

 private:
  void fill(ObjBlock& block);
  void check_encoding(ObjBlock& block);
  void end_last_line(FixedArray<char>& text);
  std::size_t cut_piece(ObjBlock& block);

  ByteSource& source_;
  std::string path_;
  std::size_t block_bytes_;
  FixedArray<char> carry_;  ///< text read, but not handed out yet
  bool at_start_ = true;
  bool at_end_ = false;
  bool in_long_line_ = false;
};

}  // namespace atlasgauge
