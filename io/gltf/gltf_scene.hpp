#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/gltf/gltf_model.hpp"
#include "io/model/affine.hpp"

namespace atlasgauge {

/// A mesh as a node shows it.
struct GltfShownMesh {
  std::uint32_t mesh;
  Affine transform;
};

/// What a scene shows, and what of it is left out.
struct GltfScene {
  std::vector<GltfShownMesh> meshes;  ///< in the order of the nodes, depth first
  std::uint64_t skinned = 0;          ///< nodes
};

/// Walks the default scene, or the first, or without scenes all nodes that are no child. `root`
/// goes around all of them. Throws Error(kInput) for nodes or meshes that are not there, a node
/// with two parents or itself among its ancestors (section 3.5.2), and for EXT_mesh_gpu_instancing.
GltfScene walk_scene(const GltfModel& model, const Affine& root, const std::string& path);

}  // namespace atlasgauge
