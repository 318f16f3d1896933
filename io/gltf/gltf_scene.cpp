#include "io/gltf/gltf_scene.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

struct Visit {
  std::uint32_t node;
  Affine parent;
};

class Walk {
 public:
  Walk(const GltfModel& model, const std::string& path)
      : model_(model), path_(path), is_visited_(model.nodes.size()) {}

  GltfScene run(const std::vector<std::uint32_t>& roots, const Affine& root) {
    push(roots, root);
    while (!open_.empty()) {
      const Visit visit = open_.back();
      open_.pop_back();
      enter(visit);
    }
    return std::move(scene_);
  }

 private:
  void push(const std::vector<std::uint32_t>& nodes, const Affine& parent) {
    for (std::size_t i = nodes.size(); i > 0; --i) open_.push_back({nodes[i - 1], parent});
  }

  void enter(const Visit& visit) {
    if (visit.node >= model_.nodes.size()) {
      refuse(fmt::format("found node {}, but there are {}", visit.node, model_.nodes.size()));
    }
    if (is_visited_[visit.node]) {
      refuse(fmt::format(
          "node {} is reached twice, expected a tree of nodes; export the model anew", visit.node));
    }
    is_visited_[visit.node] = true;
    const GltfNode& node = model_.nodes[visit.node];
    const Affine transform = visit.parent * node.transform;
    if (node.mesh) show(node, visit.node, transform);
    push(node.children, transform);
  }

  void show(const GltfNode& node, std::uint32_t number, const Affine& transform) {
    if (*node.mesh >= model_.meshes.size()) {
      refuse(fmt::format("node {} names mesh {}, but there are {}", number, *node.mesh,
                         model_.meshes.size()));
    }
    if (node.is_instanced) {
      refuse(
          fmt::format("node {} shows a mesh many times by EXT_mesh_gpu_instancing, which is not "
                      "read here; convert the model, as with gltf-transform uninstance",
                      number));
    }
    if (node.has_skin) ++scene_.skinned;
    scene_.meshes.push_back({*node.mesh, transform});
  }

  [[noreturn]] void refuse(const std::string& text) const {
    throw Error(ErrorKind::kInput, path_, 0, text);
  }

  const GltfModel& model_;
  const std::string& path_;
  std::vector<bool> is_visited_;
  std::vector<Visit> open_;
  GltfScene scene_;
};

/// Without scenes. If there is none, every node is some node's child: a cycle.
std::vector<std::uint32_t> nodes_without_parent(const GltfModel& model, const std::string& path) {
  std::vector<bool> has_parent(model.nodes.size());
  for (const GltfNode& node : model.nodes) {
    for (const std::uint32_t child : node.children) {
      if (child < has_parent.size()) has_parent[child] = true;
    }
  }
  std::vector<std::uint32_t> roots;
  for (std::uint32_t node = 0; node < model.nodes.size(); ++node) {
    if (!has_parent[node]) roots.push_back(node);
  }
  if (roots.empty() && !model.nodes.empty()) {
    throw Error(ErrorKind::kInput, path, 0, "every node is the child of another: a cycle");
  }
  return roots;
}

std::vector<std::uint32_t> root_nodes(const GltfModel& model, const std::string& path) {
  if (model.scenes.empty()) return nodes_without_parent(model, path);
  const std::uint32_t scene = model.default_scene.value_or(0);
  if (scene < model.scenes.size()) return model.scenes[scene];
  throw Error(ErrorKind::kInput, path, 0,
              fmt::format("the default scene is {}, but there are {}", scene, model.scenes.size()));
}

}  // namespace

GltfScene walk_scene(const GltfModel& model, const Affine& root, const std::string& path) {
  return Walk(model, path).run(root_nodes(model, path), root);
}

}  // namespace atlasgauge
