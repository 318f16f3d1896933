#pragma once

#include <string>

#include "io/draco/draco_mesh.hpp"
#include "io/file/byte_range.hpp"

namespace atlasgauge {

/// The header of a stream, and the bytes that it was read from.
struct DracoBegin {
  DracoHeader header;
  std::string bytes;
};

/// Reads as much of a stream as its header takes, which metadata may make long. Throws as
/// read_draco_header() does, and Error(kResource) for more than 4 MiB of metadata.
DracoBegin read_draco_begin(const ByteRange& stream);

}  // namespace atlasgauge
