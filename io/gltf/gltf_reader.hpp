#pragma once

#include <memory>
#include <string>

#include "io/file/file_listener.hpp"
#include "io/gltf/gltf_content.hpp"
#include "io/gltf/gltf_images.hpp"
#include "io/model/part_reader.hpp"
#include "io/warnings.hpp"

namespace atlasgauge {

/// Reads a glTF 2.0, `.gltf` or `.glb`, told apart by its first bytes. A part is a primitive of
/// triangles under one node of the scene, in the order of the nodes, depth first.
///
/// - Positions are the node's matrix times the stored value, in double; under nodes that change
///   nothing they are the stored values. Axes and units stay: y is up.
/// - A node that mirrors turns its triangles (section 3.7.4 turns their front sides), so that parts
///   side by side run the same way round.
/// - The texture is that of the base colour, else KHR_materials_pbrSpecularGlossiness's diffuse
/// one,
///   else the emissive one where the base colour is black. It says which TEXCOORD_n counts; v = 0
///   is turned to the bottom row (UvMap).
/// - Skins and morph targets are ignored, with a warning; points and lines are skipped, so are
///   primitives compressed by meshopt, unless nothing else is there.
///
/// While it is opened, the JSON and what it says take up to twice limits.json.memory_bytes, from
/// then on what it says, once. Files are opened when they are read and closed behind; load() of a
/// part finds what may be wrong in its values, so that emit() throws only where a file has changed
/// since.
class GltfReader : public PartReader {
 public:
  /// Throws Error(kInput) for a glTF that is broken, has no triangles, or requires unknown
  /// extensions; Error(kResource) where the limits do not do.
  GltfReader(const std::string& path, const GltfLimits& limits, Warnings& warnings,
             const FileListener& files = {});

  std::unique_ptr<MeshPart> next() override { return content_.next(); }
  const PartMaterials& materials() const override { return images_.materials(); }

 private:
  GltfImages images_;
  GltfContent content_;
};

/// Throws Error(kInput) for a model of one glTF that has nothing to measure.
void require_triangles(const GltfContent& content, const std::string& path);

/// What tells the images of a model that is one glTF.
GltfOrigin lone_origin(const std::string& path);

}  // namespace atlasgauge
