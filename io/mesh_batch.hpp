#pragma once

#include <cmath>
#include <cstdint>
#include <span>

#include "io/ids.hpp"

namespace atlasgauge {

struct Position {
  double x, y, z;
};

inline bool is_finite(const Position& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Texture coordinate, v = 0 at the bottom row of the image. Text is rounded to float once; -0 is
/// stored as +0, so equality is equality of the bits unless a value is NaN.
struct TexCoord {
  float u, v;
};

inline bool is_finite(const TexCoord& t) {
  return std::isfinite(t.u) && std::isfinite(t.v);
}

/// One triangle as the file names it. A polygon (c0, c1, c2, c3, ...) is the fan (c0,c1,c2),
/// (c0,c2,c3), ... `v` is absolute in the model and may point past the positions read so far;
/// `t` is kNone or absolute, and means "no UV" when it names nothing in the whole model.
struct FaceRecord {
  VertexId v[3];
  TexCoordId t[3];
  MaterialId material;
};
static_assert(sizeof(FaceRecord) == 28);

/// Faces [first_face, first_face + face_count) came from one polygon that names a vertex not read
/// by then. They are dropped, and count as one invalid polygon, unless max_vertex turns out to
/// exist. max_vertex = UINT64_MAX never exists. Emitted in ascending order of first_face.
struct ForwardPolygon {
  std::uint64_t first_face;
  std::uint64_t face_count;
  std::uint64_t max_vertex;
  std::uint64_t line;
};

/// Values in file order, as a reader hands them out. The spans live until the sink returns.
struct MeshBatch {
  std::uint32_t part = 0;  ///< which input part; OBJ has one, tiled inputs have thousands
  std::span<const Position> positions{};
  std::span<const TexCoord> texcoords{};
  std::span<const FaceRecord> faces{};
  std::span<const ForwardPolygon> forward{};
  std::uint64_t invalid_polygons = 0;  ///< left out of `faces`, beside those of `forward`
};

/// Where readers put what they read.
class MeshSink {
 public:
  virtual ~MeshSink() = default;
  virtual void add(const MeshBatch& batch) = 0;
};

}  // namespace atlasgauge
