#include "io/ply_segments.hpp"

#include <fmt/format.h>

#include <boost/endian/buffers.hpp>
#include <string_view>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

using boost::endian::little_float64_buf_t;
using boost::endian::little_uint32_buf_t;

/// As they lie in the file, without padding.
struct Vertex {
  little_float64_buf_t x, y, z;
  Rgb color;
  little_float64_buf_t value;
};
static_assert(sizeof(Vertex) == 4 * 8 + 3);

struct Edge {
  little_uint32_buf_t vertices[2];
  Rgb color;
};
static_assert(sizeof(Edge) == 2 * 4 + 3);

template <class Record>
std::string_view bytes_of(const Record& record) {
  return {reinterpret_cast<const char*>(&record), sizeof record};
}

constexpr std::string_view kColorProperties =
    "property uchar red\nproperty uchar green\nproperty uchar blue\n";

std::string header_of(std::uint64_t segments, const std::string& value_name) {
  constexpr std::uint64_t kMostWithIntIndices = std::uint64_t{1} << 30;  // two vertices each
  const char* const index = segments <= kMostWithIntIndices ? "int" : "uint";
  return fmt::format(
      "ply\nformat binary_little_endian 1.0\n"
      "element vertex {}\nproperty double x\nproperty double y\nproperty double z\n"
      "{}property double {}\n"
      "element edge {}\nproperty {} vertex1\nproperty {} vertex2\n{}"
      "end_header\n",
      2 * segments, kColorProperties, value_name, segments, index, index, kColorProperties);
}

}  // namespace

PlySegments::PlySegments(const std::string& path, std::string value_name)
    : file_(path), value_name_(std::move(value_name)) {}

void PlySegments::begin(std::uint64_t segments) {
  constexpr std::uint64_t kMost = std::uint64_t{1} << 31;
  if (begun_ || segments > kMost) {
    throw Error(ErrorKind::kInternal, fmt::format("{} segments for a PLY", segments));
  }
  begun_ = true;
  segments_ = segments;
  file_.append(header_of(segments, value_name_));
}

void PlySegments::add_ends(const Segment& segment) {
  ++with_ends_;
  for (const Position& p : segment.ends) {
    const Vertex vertex{little_float64_buf_t(p.x), little_float64_buf_t(p.y),
                        little_float64_buf_t(p.z), segment.color,
                        little_float64_buf_t(segment.value)};
    file_.append(bytes_of(vertex));
  }
}

void PlySegments::add_edge(const Rgb& color) {
  const auto first = static_cast<std::uint32_t>(2 * with_edge_++);
  const Edge edge{{little_uint32_buf_t(first), little_uint32_buf_t(first + 1)}, color};
  file_.append(bytes_of(edge));
}

void PlySegments::commit() {
  if (!begun_ || with_ends_ != segments_ || with_edge_ != segments_) {
    throw Error(ErrorKind::kInternal, fmt::format("a PLY of {} segments has {} ends and {} edges",
                                                  segments_, with_ends_, with_edge_));
  }
  file_.commit();
}

}  // namespace atlasgauge
