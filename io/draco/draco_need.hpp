#pragma once

#include <algorithm>
#include <cstdint>

#include "io/model/mesh_part.hpp"

/// What Draco 1.5.5 allocates while it decodes, from the arrays in its source and from measuring
/// generated grids and soups of half a million faces: a grid with 16 bits a
/// position and 14 a texture coordinate takes 37 bytes a face sequentially, 74 with edgebreaker and
/// one connectivity, 97 to 109 with seams of its own; 245 where all faces lie apart in the texture.
namespace atlasgauge::draco_need {

/// Draco's encoder got 2158 faces of a flat square grid, whose corners lie exactly on the grid of
/// the quantization, into a byte. Entropy coding has no lower bound, so this is not one either; but
/// no stream that says something about a surface comes near.
inline constexpr std::uint64_t kMostFacesPerByte = 1 << 14;

/// A guess for streams whose counts are not known yet.
inline constexpr std::uint64_t kUsualBytesPerStreamByte = 64;

/// Bytes for the values of one attribute: as integers, as what they are, and indices into them.
inline constexpr std::uint64_t kPositionBytes = 28;
inline constexpr std::uint64_t kAttributeBytes = 24;  ///< a normal, a colour, two UVs less a bit

/// Attributes beside the positions that there is room for where the header does not count them.
inline constexpr std::uint64_t kUncountedAttributes = 3;

/// Streams may have more attributes as long as they are small.
inline constexpr std::uint64_t kFixedBytes = std::uint64_t{1} << 20;

/// An entry of metadata takes three bytes or more in a stream, and a node of a table in memory.
inline constexpr std::uint64_t kBytesPerMetadataByte = 64;

struct Need {
  std::uint64_t connectivity_bytes;
  std::uint64_t attribute_bytes;
};

inline Need sequential(const PartCounts& counts) {
  const std::uint64_t point_bytes = kPositionBytes + kUncountedAttributes * kAttributeBytes;
  return {counts.faces * 28, counts.positions * point_bytes + kFixedBytes};
}

/// One connectivity for all attributes.
inline Need edgebreaker(const PartCounts& counts, std::uint64_t splits) {
  const std::uint64_t vertices = counts.positions + splits;
  const std::uint64_t vertex_bytes = kPositionBytes + kUncountedAttributes * kAttributeBytes;
  return {counts.faces * 44 + vertices * 32, vertices * vertex_bytes + kFixedBytes};
}

/// Attributes with seams of their own may have a value and a point for each corner.
inline Need seamed_edgebreaker(const PartCounts& counts, std::uint64_t splits,
                               std::uint64_t attributes) {
  const std::uint64_t vertices = counts.positions + splits;
  const std::uint64_t points = std::max(vertices, 3 * counts.faces);
  return {counts.faces * (44 + attributes * 20) + vertices * 32 + points * attributes * 40,
          vertices * kPositionBytes + points * attributes * kAttributeBytes + kFixedBytes};
}

}  // namespace atlasgauge::draco_need
