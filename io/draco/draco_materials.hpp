#pragma once

#include <draco/metadata/geometry_metadata.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace atlasgauge {

/// The attribute named "material" that Draco's own OBJ encoder writes: its values number materials,
/// whose names are entries of its metadata.
struct DracoMaterials {
  std::uint32_t attribute_id;      ///< the unique one
  std::vector<std::string> names;  ///< by value; empty where none has the value
};

std::optional<DracoMaterials> find_draco_materials(const draco::GeometryMetadata& metadata);

}  // namespace atlasgauge
