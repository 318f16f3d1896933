#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace atlasgauge {

static_assert(std::endian::native == std::endian::little, "files are read as they lie there");

/// The number that the first bytes at `from` are, wherever they lie.
template <class T>
T read_number(const char* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

}  // namespace atlasgauge
