#include "io/draco/draco_materials.hpp"

#include <draco/core/decoder_buffer.h>
#include <draco/metadata/metadata_decoder.h>

#include <utility>

#include "io/draco/draco_mesh.hpp"

namespace atlasgauge {
namespace {

/// Before the metadata, where there are any.
constexpr std::size_t kStartBytes = 11;

}  // namespace

std::optional<DracoMaterials> find_draco_materials(const draco::GeometryMetadata& metadata) {
  const draco::AttributeMetadata* const attribute =
      metadata.GetAttributeMetadataByStringEntry("name", "material");
  if (attribute == nullptr) return std::nullopt;
  DracoMaterials materials{attribute->att_unique_id(), {}};
  const auto& entries = attribute->entries();
  for (const auto& [name, entry] : entries) {
    std::int32_t value = 0;
    const bool is_material = name != "name" && name != "file_name" && entry.GetValue(&value) &&
                             value >= 0 && std::cmp_less(value, entries.size());
    if (!is_material) continue;
    const auto index = static_cast<std::size_t>(value);
    if (materials.names.size() <= index) materials.names.resize(index + 1);
    materials.names[index] = name;
  }
  return materials;
}

std::vector<std::string> read_draco_material_names(std::string_view begin,
                                                   const DracoHeader& header) {
  if (!header.has_metadata || header.begin_bytes_needed != 0) return {};
  draco::DecoderBuffer buffer;
  buffer.Init(begin.data() + kStartBytes, begin.size() - kStartBytes);
  draco::GeometryMetadata metadata;
  if (!draco::MetadataDecoder().DecodeGeometryMetadata(&buffer, &metadata)) return {};
  std::optional<DracoMaterials> materials = find_draco_materials(metadata);
  return materials ? std::move(materials->names) : std::vector<std::string>{};
}

}  // namespace atlasgauge
