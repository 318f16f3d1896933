#pragma once

#include <cstdint>
#include <limits>

namespace atlasgauge {

/// Indices, one type a kind, 0-based. All are 32 bits wide on disk and in memory; readers refuse a
/// model with more elements (kMaxElements), so an index never wraps. Counts are 64 bits.
enum class VertexId : std::uint32_t {};
enum class TexCoordId : std::uint32_t {};
enum class FaceId : std::uint32_t {};
enum class MaterialId : std::uint32_t {};
enum class SlotId : std::uint32_t {};

/// No vertex, no texture coordinate, no material, no slot.
template <class Id>
inline constexpr Id kNone = static_cast<Id>(std::numeric_limits<std::uint32_t>::max());

/// Largest number of positions, texture coordinates or faces in one model. It leaves two bits of a
/// face index free for the flags that labels carry, and lets all corners be numbered in 32 bits.
inline constexpr std::uint64_t kMaxElements = (std::uint64_t{1} << 30) - 1;

template <class Id>
constexpr std::uint32_t raw(Id id) {
  return static_cast<std::uint32_t>(id);
}

}  // namespace atlasgauge
