#pragma once

#include <vector>

#include "io/file/byte_range.hpp"
#include "io/json/bounded_json.hpp"
#include "io/model/affine.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// A glTF in the file of a tile.
struct TileGltf {
  ByteRange gltf;
  Affine rtc;  ///< RTC_CENTER: goes around it, its axes turned
};

/// Whether the bytes are a Batched 3D Model.
bool is_b3dm(const ByteRange& range);

/// The glTF of a Batched 3D Model (3D Tiles 1.0, "b3dm"), also with the headers of 20 and 24 bytes
/// that came before it. Throws Error(kInput).
TileGltf find_in_b3dm(const ByteRange& range, const JsonLimits& limits);

/// The glTF in a tile's file, told by its first bytes: a Batched 3D Model, a Composite (also one in
/// another), or a glTF itself. Point clouds (pnts) and instances (i3dm) are left out with a
/// warning. Throws Error(kInput) for anything else.
std::vector<TileGltf> find_in_tile(const ByteRange& range, const JsonLimits& limits,
                                   Warnings& warnings);

}  // namespace atlasgauge
