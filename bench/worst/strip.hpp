#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "bench/worst/numbering.hpp"
#include "bench/worst/obj_file.hpp"
#include "bench/worst/shape.hpp"

namespace atlasgauge {

/// A zigzag strip of triangles (i, i + 1, i + 2). Vertex j lies at (3j, 4(j mod 2)), so that all
/// sides are 5, 5 and 6 long, and its UV is (j, j mod 2).
///
/// Closed, the vertices are taken modulo their number, which is that of the faces: an annulus when
/// that is even, a Moebius strip when it is odd, since the side j, j + 2, … then runs through all
/// vertices before it comes back. Two long triangles go back to the start.
struct Strip {
  std::uint64_t faces = 0;
  bool closed = false;
  /// All faces run the same way. Otherwise no two neighbours do, so that every step along the strip
  /// changes the orientation.
  bool coherent = true;
  Numbering::Kind order = Numbering::Kind::kInOrder;  ///< of faces and of vertices

  std::uint64_t vertices() const { return closed ? faces : faces + 2; }

  /// Vertices of a face.
  std::array<std::uint64_t, 3> face(std::uint64_t i) const {
    const std::uint64_t last = vertices();
    const bool turn = coherent && i % 2 == 0;
    const std::uint64_t b = (i + 1) % last, c = (i + 2) % last;
    return turn ? std::array{i, c, b} : std::array{i, b, c};
  }
};

void put_strip_vertices(const Strip& strip, ObjFile& obj);
void put_strip_texcoords(const Strip& strip, ObjFile& obj);
/// With UVs.
void put_strip_faces(const Strip& strip, ObjFile& obj);
void write_strip(const Strip& strip, const std::string& stem);

/// An open, coherent strip; in any order.
Shape open_strip_shape(std::uint64_t faces);

/// The same without UVs.
Shape unmapped_strip_shape(std::uint64_t faces);

}  // namespace atlasgauge
