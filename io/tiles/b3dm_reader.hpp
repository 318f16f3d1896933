#pragma once

#include <memory>
#include <string>

#include "io/file/file_listener.hpp"
#include "io/gltf/gltf_content.hpp"
#include "io/gltf/gltf_images.hpp"
#include "io/gltf/gltf_reader.hpp"
#include "io/model/part_reader.hpp"
#include "io/tiles/tile_content.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// Reads a single Batched 3D Model as GltfReader does its glTF. RTC_CENTER is added to its
/// positions; nothing else is known of its place, so the axes stay as the glTF has them: only a
/// tileset says which one is up.
class B3dmReader : public PartReader {
 public:
  /// Throws as GltfReader does.
  B3dmReader(const std::string& path, const GltfLimits& limits, Warnings& warnings,
             const FileListener& files = {});

  std::unique_ptr<MeshPart> next() override { return content_.next(); }
  const PartMaterials& materials() const override { return images_.materials(); }

 private:
  B3dmReader(const std::string& path, const TileGltf& tile, const GltfLimits& limits,
             Warnings& warnings, const FileListener& files);

  GltfImages images_;
  GltfContent content_;
};

}  // namespace atlasgauge
