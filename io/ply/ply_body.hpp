#pragma once

#include <cstddef>
#include <string>

#include "io/mesh_batch.hpp"
#include "io/ply/ply_header.hpp"
#include "io/ply/ply_input.hpp"
#include "io/ply/ply_layout.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// Most bytes that read_ply_body() allocates.
std::size_t ply_body_bytes();

/// Reads all elements behind the header and hands their values to a sink. Throws Error(kInput) for
/// numbers that cannot be read and for a file that ends before what its header promises, with the
/// line (ascii) or the offset (binary).
void read_ply_body(PlyInput& input, const PlyHeader& header, const PlyLayout& layout,
                   const std::string& path, MeshSink& sink, Warnings& warnings);

}  // namespace atlasgauge
