#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "io/model/affine.hpp"

namespace atlasgauge {

/// The parts of a glTF 2.0 document that measuring needs, by the names of its specification.
/// Indices are those of the document, and not checked; numbers are.
enum class GltfComponent : std::uint32_t {
  kByte = 5120,
  kUnsignedByte = 5121,
  kShort = 5122,
  kUnsignedShort = 5123,
  kUnsignedInt = 5125,
  kFloat = 5126,
};

std::uint32_t component_bytes(GltfComponent type);

enum class GltfMode : std::uint32_t {
  kPoints = 0,
  kLines = 1,
  kLineLoop = 2,
  kLineStrip = 3,
  kTriangles = 4,
  kTriangleStrip = 5,
  kTriangleFan = 6,
};

/// Bytes that the document holds itself (a data: URI), or names.
struct GltfUri {
  std::string text;                            ///< empty for a data: URI, and without any
  std::shared_ptr<const std::string> content;  ///< of a data: URI
  bool is_given() const { return !text.empty() || content != nullptr; }
};

struct GltfBuffer {
  GltfUri uri;
  std::uint64_t byte_length = 0;
  bool is_fallback = false;  ///< by the meshopt extensions: it may have no bytes
};

struct GltfBufferView {
  std::uint32_t buffer = 0;
  std::uint64_t byte_offset = 0;
  std::uint64_t byte_length = 0;
  std::uint32_t byte_stride = 0;                 ///< 0: elements lie side by side
  std::optional<std::string> meshopt_extension;  ///< that its data are compressed with
};

struct GltfSparse {
  std::uint64_t count = 0;
  std::uint32_t index_view = 0;
  std::uint64_t index_offset = 0;
  GltfComponent index_type = GltfComponent::kUnsignedInt;
  std::uint32_t value_view = 0;
  std::uint64_t value_offset = 0;
};

struct GltfAccessor {
  std::optional<std::uint32_t> view;  ///< none: zeros
  std::uint64_t byte_offset = 0;
  GltfComponent type = GltfComponent::kFloat;
  bool normalized = false;
  std::uint64_t count = 0;
  std::uint32_t components = 1;
  std::optional<GltfSparse> sparse;
};

/// KHR_draco_mesh_compression: attributes by their unique ids in the stream.
struct GltfDraco {
  std::uint32_t view = 0;
  std::optional<std::uint32_t> position;
  std::map<std::uint32_t, std::uint32_t> texcoords;  ///< by n of TEXCOORD_n
};

struct GltfPrimitive {
  GltfMode mode = GltfMode::kTriangles;
  std::optional<std::uint32_t> position;
  std::map<std::uint32_t, std::uint32_t> texcoords;  ///< by n of TEXCOORD_n
  std::optional<std::uint32_t> indices;
  std::optional<std::uint32_t> material;
  std::optional<GltfDraco> draco;
  bool has_targets = false;
};

using GltfMesh = std::vector<GltfPrimitive>;

struct GltfNode {
  Affine transform;
  std::vector<std::uint32_t> children;
  std::optional<std::uint32_t> mesh;
  bool has_skin = false;
  bool is_instanced = false;  ///< EXT_mesh_gpu_instancing
};

/// KHR_texture_transform. In texture coordinates with v = 0 at the top, as glTF has them.
struct UvTransform {
  double offset[2] = {0, 0};
  double rotation = 0;  ///< radians, counter-clockwise as the image shows
  double scale[2] = {1, 1};

  bool operator==(const UvTransform&) const = default;
};

/// The texture that gives a material its colour.
struct GltfColour {
  std::uint32_t texture = 0;
  std::uint32_t texcoord = 0;  ///< n of TEXCOORD_n
  UvTransform transform;
};

struct GltfMaterial {
  std::optional<GltfColour> colour;
};

struct GltfTexture {
  std::optional<std::uint32_t> image;
  bool is_basis = false;  ///< KHR_texture_basisu without a fallback
};

struct GltfImage {
  GltfUri uri;
  std::optional<std::uint32_t> view;
  std::string name;
  bool is_basis = false;  ///< by its media type
};

struct GltfModel {
  std::vector<GltfBuffer> buffers;
  std::vector<GltfBufferView> views;
  std::vector<GltfAccessor> accessors;
  std::vector<GltfMesh> meshes;
  std::vector<GltfNode> nodes;
  std::vector<std::vector<std::uint32_t>> scenes;  ///< root nodes
  std::optional<std::uint32_t> default_scene;
  std::vector<GltfMaterial> materials;
  std::vector<GltfTexture> textures;
  std::vector<GltfImage> images;
  Affine rtc;  ///< CESIUM_RTC
};

/// Whether a member of the document is needed: what parse_gltf() looks at.
bool is_gltf_member(std::string_view key);

/// Throws Error(kInput) for a document that is none of glTF 2.0, whose values are of the wrong
/// kind, or that requires an extension which changes geometry or texture coordinates in a way
/// unknown here.
GltfModel parse_gltf(const nlohmann::json& document, const std::string& path);

}  // namespace atlasgauge
