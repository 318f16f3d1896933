#include "io/gltf/gltf_content.hpp"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <utility>

#include "io/error.hpp"
#include "io/gltf/glb.hpp"
#include "io/gltf/gltf_buffers.hpp"

namespace atlasgauge {
namespace {

/// The geometry of the meshes that are shown, each found once.
class Meshes {
 public:
  using Primitives = std::vector<std::shared_ptr<const GltfGeometry>>;

  Meshes(const GltfModel& model, GltfBuffers& buffers, Warnings& warnings)
      : model_(model), buffers_(buffers), warnings_(warnings) {}

  const Primitives& of(std::uint32_t mesh) {
    const auto known = found_.find(mesh);
    if (known != found_.end()) return known->second;
    return found_.emplace(mesh, find(mesh)).first->second;
  }

  /// Of those asked for.
  std::uint64_t with_targets() const { return with_targets_; }
  const std::optional<std::string>& unreadable() const { return unreadable_; }

 private:
  Primitives find(std::uint32_t mesh) {
    Primitives primitives;
    for (const GltfPrimitive& primitive : model_.meshes[mesh]) {
      const std::string name =
          fmt::format("primitive {} of mesh {}", &primitive - model_.meshes[mesh].data(), mesh);
      if (primitive.has_targets) ++with_targets_;
      if (const auto refusal = refusal_of(model_, buffers_, primitive)) {
        refuse(*refusal, name);
        continue;
      }
      primitives.push_back(
          std::make_shared<const GltfGeometry>(find_geometry(model_, buffers_, primitive, name)));
    }
    return primitives;
  }

  void refuse(const GltfRefusal& refusal, const std::string& name) {
    const std::string text = name + " is not measured: " + refusal.text;
    warnings_.add(refusal.kind, buffers_.path(), 0, text);
    if (refusal.is_unreadable) unreadable_ = text;
  }

  const GltfModel& model_;
  GltfBuffers& buffers_;
  Warnings& warnings_;
  std::map<std::uint32_t, Primitives> found_;
  std::uint64_t with_targets_ = 0;
  std::optional<std::string> unreadable_;
};

void warn_of_pose(std::uint64_t skinned, std::uint64_t with_targets, const std::string& path,
                  Warnings& warnings) {
  if (skinned + with_targets == 0) return;
  warnings.add("rest pose", path, 0,
               fmt::format("measured as stored, without the skins of {} nodes and the morph "
                           "targets of {} primitives",
                           skinned, with_targets));
}

std::filesystem::path folder_of(const ByteRange& range) {
  return std::filesystem::path(range.path).parent_path();
}

}  // namespace

GltfContent::GltfContent(const ByteRange& range, const GltfFrame& frame, const GltfLimits& limits,
                         const GltfOrigin& origin, GltfImages& images, const FileListener& files,
                         Warnings& warnings)
    : block_bytes_(limits.block_bytes) {
  const GltfChunks chunks = find_gltf_chunks(range);
  const GltfModel model =
      parse_gltf(read_json(chunks.json, limits.json, is_gltf_member), range.path);
  const Affine root = frame.outer * model.rtc * frame.up;
  const GltfScene scene = walk_scene(model, root, range.path);
  GltfBuffers buffers(model, range.path, folder_of(range), chunks.binary, files);
  Meshes meshes(model, buffers, warnings);
  for (const GltfShownMesh& shown : scene.meshes) {
    for (const auto& geometry : meshes.of(shown.mesh))
      shown_.push_back({geometry, shown.transform});
  }
  if (shown_.empty() && meshes.unreadable()) {
    throw Error(ErrorKind::kInput, range.path, 0, *meshes.unreadable());
  }
  warn_of_pose(scene.skinned, meshes.with_targets(), range.path, warnings);
  first_material_ = images.add(model, buffers, origin, warnings);
}

std::unique_ptr<MeshPart> GltfContent::next() {
  if (next_ == shown_.size()) return nullptr;
  Shown& shown = shown_[next_++];
  GltfPlace place{shown.transform, kNone<MaterialId>};
  if (shown.geometry->material)
    place.material = MaterialId{first_material_ + *shown.geometry->material};
  return make_part(std::move(shown.geometry), place, block_bytes_);
}

}  // namespace atlasgauge
