#pragma once

#include "io/obj/obj_block.hpp"

namespace atlasgauge {

/// Replaces every backslash at a line end, and the line end, by blanks ('\v' for the line end).
void splice_lines(ObjBlock& block);

/// Parses whole lines from block.parsed_bytes on, until the text ends, an array is full, or a line
/// cannot be read. block.parsed_bytes and parsed_lines then say where.
void parse_lines(ObjBlock& block);

}  // namespace atlasgauge
