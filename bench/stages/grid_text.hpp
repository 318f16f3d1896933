#pragma once

#include <cstdint>
#include <string>

#include "bench/stages/grid.hpp"
#include "io/mesh_batch.hpp"

namespace atlasgauge {

/// What the statements of an OBJ come to.
struct ObjTotals {
  std::uint64_t positions = 0, texcoords = 0, faces = 0;
  std::uint64_t indices = 0;                 ///< sum over all corners
  double coordinates = 0, uv_numerator = 0;  ///< sums, exact: see GridText

  void add(const Position& p) {
    ++positions;
    coordinates += p.x + p.y + p.z;
  }
  void add(const TexCoord& t);
  void add(const FaceRecord& face);
  bool operator==(const ObjTotals&) const = default;
};

/// A grid as scanners write it: six decimals, faces as v/vt. Coordinates are multiples of 1/64.
struct GridText {
  explicit GridText(const Grid& grid);

  std::string text;
  ObjTotals totals;
};

}  // namespace atlasgauge
