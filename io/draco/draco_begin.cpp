#include "io/draco/draco_begin.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "io/bytes.hpp"
#include "io/error.hpp"

namespace atlasgauge {
namespace {

constexpr std::size_t kUsualBytes = 256;
constexpr std::uint64_t kMostBytes = std::uint64_t{4} << 20;

}  // namespace

DracoBegin read_draco_begin(const ByteRange& stream) {
  DracoBegin begin;
  begin.bytes = read_begin(stream, kUsualBytes);
  begin.header = read_draco_header(begin.bytes, stream.size, stream.path);
  while (begin.header.begin_bytes_needed != 0) {
    if (begin.header.begin_bytes_needed > kMostBytes) {
      throw Error(ErrorKind::kResource, stream.path, 0,
                  fmt::format("found more than {} of Draco metadata before the mesh; encode the "
                              "model without them",
                              format_bytes(kMostBytes)));
    }
    begin.bytes = read_begin(stream, begin.header.begin_bytes_needed);
    begin.header = read_draco_header(begin.bytes, stream.size, stream.path);
  }
  return begin;
}

}  // namespace atlasgauge
