#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace atlasgauge {

/// What an OBJ says besides geometry.
struct ObjSummary {
  std::vector<std::string> material_names;  ///< by MaterialId, in order of first `usemtl`
  std::vector<std::string> mtllib_lines;    ///< the distinct rests of `mtllib` lines, trimmed
  std::uint64_t positions = 0;
  std::uint64_t texcoords = 0;
  std::uint64_t faces = 0;               ///< triangles handed to the sink
  std::uint64_t invalid_polygons = 0;    ///< dropped already; ForwardPolygons not included
  std::uint64_t skipped_primitives = 0;  ///< `l`, `p`, curves and surfaces
  std::uint64_t unknown_statements = 0;
};

}  // namespace atlasgauge
