#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/ply/ply_input.hpp"

namespace atlasgauge {

enum class PlyFormat { kAscii, kLittleEndian, kBigEndian };

enum class PlyType : std::uint8_t {
  kInt8,
  kUint8,
  kInt16,
  kUint16,
  kInt32,
  kUint32,
  kFloat32,
  kFloat64,
};

std::size_t bytes_of(PlyType type);
bool is_integer(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type;
  std::optional<PlyType> count_type;  ///< of a list

  bool is_list() const { return count_type.has_value(); }
};

struct PlyElement {
  std::string name;
  std::uint64_t count;
  std::vector<PlyProperty> properties;
  std::uint64_t line;  ///< where the header has it

  /// Place among the properties of the first of these names that there is, as a list or not.
  std::optional<std::size_t> find(std::initializer_list<std::string_view> names,
                                  bool is_list) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::kAscii;
  std::vector<PlyElement> elements;        ///< in the order of the file
  std::vector<std::string> texture_files;  ///< of `comment TextureFile`, with slashes

  const PlyElement* find(std::string_view name) const;
};

/// Reads up to the first byte of the body. Throws Error(kInput) with path and line, or
/// Error(kResource) where names take more than NameRoom::kMaxBytes.
PlyHeader read_ply_header(PlyInput& input, const std::string& path);

}  // namespace atlasgauge
