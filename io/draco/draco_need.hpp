#pragma once

#include <algorithm>
#include <cstdint>

#include "io/model/mesh_part.hpp"

/// What Draco 1.5.5 allocates while it decodes, by the arrays in its source; measured with
/// generated grids and soups (tests/io/draco/draco_need_test.cpp).
namespace atlasgauge::draco_need {

/// Connectivity and values of the flattest grid cost 1/3000 of a byte a face with everything that
/// Draco's encoder offers; no stream that says something about a surface comes near.
inline constexpr std::uint64_t kMostFacesPerByte = 1 << 14;

/// A guess for streams whose counts are not known yet.
inline constexpr std::uint64_t kUsualBytesPerStreamByte = 64;

/// Room for the values of all attributes, a point: position, normal, texture coordinate and colour,
/// each as integers, as floats, and with its index.
inline constexpr std::uint64_t kAttributeBytesPerPoint = 112;

/// Streams may have more attributes as long as they are small.
inline constexpr std::uint64_t kFixedBytes = std::uint64_t{4} << 20;

inline std::uint64_t attributes(std::uint64_t points) {
  return points * kAttributeBytesPerPoint + kFixedBytes;
}

inline std::uint64_t sequential(const PartCounts& counts) {
  return counts.faces * 36 + attributes(counts.positions);
}

/// With seams of its own, an attribute may have a value and a point for each corner.
inline std::uint64_t edgebreaker(const PartCounts& counts, std::uint64_t splits,
                                 std::uint64_t seamed_attributes) {
  const std::uint64_t vertices = counts.positions + splits;
  const std::uint64_t points =
      seamed_attributes == 0 ? vertices : std::max(vertices, 3 * counts.faces);
  return counts.faces * (64 + seamed_attributes * 16) + vertices * 40 +
         seamed_attributes * points * 16 + attributes(points);
}

}  // namespace atlasgauge::draco_need
