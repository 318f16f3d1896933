#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "io/file/byte_range.hpp"
#include "io/file/file_listener.hpp"
#include "io/gltf/gltf_geometry.hpp"
#include "io/gltf/gltf_images.hpp"
#include "io/gltf/gltf_model.hpp"
#include "io/gltf/gltf_scene.hpp"
#include "io/json/bounded_json.hpp"
#include "io/model/affine.hpp"
#include "io/model/mesh_part.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// What reading a glTF may take.
struct GltfLimits {
  JsonLimits json;
  std::size_t block_bytes = std::size_t{1} << 20;  ///< of accessors, read at a time
};

/// Where a glTF stands in a model of several.
struct GltfFrame {
  Affine outer;  ///< goes around all, CESIUM_RTC included
  Affine up;     ///< goes around the nodes, within CESIUM_RTC: turns the axis that is up
};

/// A glTF 2.0 in a file of its own or in a stretch of one (a tile), opened and checked as a whole:
/// after the constructor only damaged values can go wrong, not the structure.
class GltfContent {
 public:
  /// URIs are relative to the folder of the range's file; `files` hears of the buffers there.
  /// Throws Error(kInput), and Error(kResource) where the limits do not do; then nothing is added
  /// to `images`.
  GltfContent(const ByteRange& range, const GltfFrame& frame, const GltfLimits& limits,
              const GltfOrigin& origin, GltfImages& images, const FileListener& files,
              Warnings& warnings);

  /// The next primitive under the next node, or null after the last.
  std::unique_ptr<MeshPart> next();

  /// Whether it shows any triangles.
  bool is_empty() const { return shown_.empty(); }

 private:
  struct Shown {
    std::shared_ptr<const GltfGeometry> geometry;
    Affine transform;
  };

  std::size_t block_bytes_;
  std::vector<Shown> shown_;
  std::size_t next_ = 0;
  std::uint32_t first_material_ = 0;
};

}  // namespace atlasgauge
