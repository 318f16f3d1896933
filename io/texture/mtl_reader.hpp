#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/warnings.hpp"

namespace atlasgauge {

/// A material, reduced to what measuring needs.
struct Material {
  std::string name;
  /// `map_Kd` as spelled, options skipped, backslashes turned into slashes.
  std::optional<std::string> image;
};

/// All `newmtl` of a file, in order; of two equal names both are listed. Throws Error(kInput),
/// or Error(kResource) where the names exceed NameRoom::kMaxBytes.
std::vector<Material> read_mtl(const std::string& path, Warnings& warnings);

/// The same, but a library that cannot be read is a warning, and has no materials.
std::vector<Material> read_mtl_if_readable(const std::string& path, Warnings& warnings);

}  // namespace atlasgauge
