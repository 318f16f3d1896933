#pragma once

#include <cstdint>
#include <string>

#include "io/file/output_file.hpp"
#include "io/mesh_batch.hpp"

namespace atlasgauge {

struct Rgb {
  std::uint8_t red, green, blue;
};

/// A straight line in space.
struct Segment {
  Position ends[2];
  Rgb color;
  double value;  ///< of any meaning; not a NaN, as viewers take it for a scale
};

/// Coloured segments as a binary little-endian PLY, that is there whole or not at all: see
/// OutputFile. Viewers differ in what they draw, so it says the colour twice: a segment is two
/// vertices of its own (double x, y, z; uchar red, green, blue; double of a name that is given) and
/// an `edge` (vertex1, vertex2; uchar red, green, blue). Indices are ints as far as they go, since
/// MeshLab reads no others.
class PlySegments {
 public:
  PlySegments(const std::string& path, std::string value_name);

  /// First, once.
  void begin(std::uint64_t segments);
  /// Then all segments, and after them all their colours once more, in the same order: vertices
  /// come before edges in the file.
  void add_ends(const Segment& segment);
  void add_edge(const Rgb& color);

  /// Throws Error(kInternal) unless all that was announced is there.
  void commit();

 private:
  OutputFile file_;
  const std::string value_name_;
  bool begun_ = false;
  std::uint64_t segments_ = 0, with_ends_ = 0, with_edge_ = 0;
};

}  // namespace atlasgauge
