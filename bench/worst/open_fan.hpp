#pragma once

#include <cstdint>

#include "bench/worst/obj_file.hpp"
#include "bench/worst/shape.hpp"

namespace atlasgauge {

/// The fan of the polygon (0, 2), (0, 0), (1, 0), …, (faces, 0), without UVs.
void put_open_fan_vertices(std::uint64_t faces, ObjFile& obj);
Shape open_fan_shape(std::uint64_t faces);

}  // namespace atlasgauge
