#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <variant>

namespace atlasgauge {

enum class MapValue { kFloat, kUint };

inline constexpr std::size_t kMapValueBytes = 4;

struct MapChannel {
  std::string name;
  MapValue value = MapValue::kFloat;
};

/// What one channel has in one tile: rows from the top down, each of the tile size.
using MapTexels = std::variant<std::span<const float>, std::span<const std::uint32_t>>;

}  // namespace atlasgauge
