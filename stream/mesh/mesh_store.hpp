#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "io/mesh_batch.hpp"
#include "stream/engine/budget.hpp"
#include "stream/engine/last_uses.hpp"
#include "stream/engine/spill.hpp"

namespace atlasgauge {

/// Axis-aligned box of the finite positions; empty until the first.
struct BoundingBox {
  Position low{0, 0, 0};
  Position high{0, 0, 0};
  bool empty = true;

  void add(const Position& p);
  double longest_side() const;
};

/// Where a part of a model begins. Parts follow each other.
struct PartStart {
  std::uint64_t first_face;
  double position_step;  ///< to which it rounds its positions, in model units; 0: it does not
};

/// A model in scratch, in file order.
struct MeshStore {
  Spill<Position> positions;
  Spill<TexCoord> texcoords;
  Spill<FaceRecord> faces;
  /// Of vertices by faces. Faces that were dropped count, so a use may seem later than it is.
  LastUses last_faces;
  Reservation parts_memory;
  std::vector<PartStart> parts;
  BoundingBox box;
  std::uint64_t invalid_polygons = 0;
  bool uvs_in_unit_square = true;  ///< every finite texture coordinate lies in [0,1]
};

/// Notes the last uses of the vertices of `faces`, which `before` others precede.
void note_last_faces(std::span<const FaceRecord> faces, std::uint64_t before, LastUses& last_faces);

}  // namespace atlasgauge
