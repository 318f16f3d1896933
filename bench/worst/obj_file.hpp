#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "bench/text_file.hpp"

namespace atlasgauge {

/// An OBJ of whole coordinates. Vertices and texture coordinates are numbered from 0.
class ObjFile : public TextFile {
 public:
  explicit ObjFile(const std::string& stem) : TextFile(stem + ".obj") {}

  void put_vertex(std::uint64_t x, std::uint64_t y, std::uint64_t z = 0) {
    put("v ");
    put(x);
    put(' ');
    put(y);
    put(' ');
    put(z);
    put('\n');
  }

  void put_texcoord(std::uint64_t u, std::uint64_t v) {
    put("vt ");
    put(u);
    put(' ');
    put(v);
    put('\n');
  }

  /// Corners without UV.
  void put_face(const std::array<std::uint64_t, 3>& v) {
    put('f');
    for (const std::uint64_t index : v) {
      put(' ');
      put(index + 1);
    }
    put('\n');
  }

  void put_face(const std::array<std::uint64_t, 3>& v, const std::array<std::uint64_t, 3>& t) {
    put('f');
    for (std::size_t k = 0; k < 3; ++k) {
      put(' ');
      put(v[k] + 1);
      put('/');
      put(t[k] + 1);
    }
    put('\n');
  }
};

}  // namespace atlasgauge
