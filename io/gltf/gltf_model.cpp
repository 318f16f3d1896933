#include "io/gltf/gltf_model.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include "io/file/uri.hpp"
#include "io/gltf/gltf_extensions.hpp"
#include "io/json/json_affine.hpp"
#include "io/json/json_view.hpp"

namespace atlasgauge {
namespace {

constexpr std::string_view kTexCoordPrefix = "TEXCOORD_";
constexpr std::array kMeshoptExtensions = {"EXT_meshopt_compression", "KHR_meshopt_compression"};

/// In the order of the alphabet.
constexpr std::array<std::string_view, 64> kMembers = {"CESIUM_RTC",
                                                       "EXT_mesh_gpu_instancing",
                                                       "EXT_meshopt_compression",
                                                       "EXT_texture_avif",
                                                       "EXT_texture_webp",
                                                       "KHR_draco_mesh_compression",
                                                       "KHR_materials_pbrSpecularGlossiness",
                                                       "KHR_meshopt_compression",
                                                       "KHR_texture_basisu",
                                                       "KHR_texture_transform",
                                                       "MSFT_texture_dds",
                                                       "POSITION",
                                                       "accessors",
                                                       "asset",
                                                       "attributes",
                                                       "baseColorFactor",
                                                       "baseColorTexture",
                                                       "buffer",
                                                       "bufferView",
                                                       "bufferViews",
                                                       "buffers",
                                                       "byteLength",
                                                       "byteOffset",
                                                       "byteStride",
                                                       "center",
                                                       "children",
                                                       "componentType",
                                                       "count",
                                                       "diffuseTexture",
                                                       "emissiveTexture",
                                                       "extensions",
                                                       "extensionsRequired",
                                                       "fallback",
                                                       "images",
                                                       "index",
                                                       "indices",
                                                       "material",
                                                       "materials",
                                                       "matrix",
                                                       "mesh",
                                                       "meshes",
                                                       "mimeType",
                                                       "mode",
                                                       "name",
                                                       "nodes",
                                                       "normalized",
                                                       "offset",
                                                       "pbrMetallicRoughness",
                                                       "primitives",
                                                       "rotation",
                                                       "scale",
                                                       "scene",
                                                       "scenes",
                                                       "skin",
                                                       "source",
                                                       "sparse",
                                                       "targets",
                                                       "texCoord",
                                                       "textures",
                                                       "translation",
                                                       "type",
                                                       "uri",
                                                       "values",
                                                       "version"};

std::optional<std::uint32_t> index_of(const JsonView& object, const char* key) {
  const std::optional<JsonView> member = object.find(key);
  if (!member) return std::nullopt;
  return member->index();
}

std::optional<JsonView> extension_of(const JsonView& object, const char* name) {
  const std::optional<JsonView> extensions = object.find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

std::vector<std::uint32_t> indices_of(const JsonView& object, const char* key) {
  std::vector<std::uint32_t> indices;
  for (const JsonView& element : object.elements(key)) indices.push_back(element.index());
  return indices;
}

GltfComponent component_of(const JsonView& object) {
  const JsonView type = object.at("componentType");
  const std::uint64_t number = type.whole();
  const bool is_known = number >= 5120 && number <= 5126 && number != 5124;
  if (!is_known) type.refuse("expected one of 5120, 5121, 5122, 5123, 5125, 5126");
  return static_cast<GltfComponent>(number);
}

std::uint32_t components_of(const JsonView& accessor) {
  constexpr std::array<std::pair<std::string_view, std::uint32_t>, 7> kTypes = {{{"SCALAR", 1},
                                                                                 {"VEC2", 2},
                                                                                 {"VEC3", 3},
                                                                                 {"VEC4", 4},
                                                                                 {"MAT2", 4},
                                                                                 {"MAT3", 9},
                                                                                 {"MAT4", 16}}};
  const JsonView type = accessor.at("type");
  for (const auto& [name, components] : kTypes) {
    if (type.text() == name) return components;
  }
  type.refuse("expected SCALAR, VEC2, VEC3, VEC4, MAT2, MAT3 or MAT4");
}

GltfUri parse_uri(const JsonView& object) {
  const std::optional<JsonView> uri = object.find("uri");
  if (!uri) return {};
  if (!is_data_uri(uri->text())) return {uri->text(), nullptr};
  std::optional<std::string> bytes = data_uri_bytes(uri->text());
  if (!bytes) uri->refuse("found a data: URI whose base64 is broken");
  return {{}, std::make_shared<const std::string>(*std::move(bytes))};
}

GltfBuffer parse_buffer(const JsonView& buffer) {
  GltfBuffer result;
  result.uri = parse_uri(buffer);
  result.byte_length = buffer.at("byteLength").whole();
  for (const char* const name : kMeshoptExtensions) {
    const std::optional<JsonView> meshopt = extension_of(buffer, name);
    if (meshopt && meshopt->flag_or("fallback", false)) result.is_fallback = true;
  }
  return result;
}

GltfBufferView parse_view(const JsonView& view) {
  constexpr std::uint64_t kMostStride = 252;  // section 5.11
  GltfBufferView result;
  result.buffer = view.at("buffer").index();
  result.byte_offset = view.whole_or("byteOffset", 0);
  result.byte_length = view.at("byteLength").whole();
  const std::uint64_t stride = view.whole_or("byteStride", 0);
  if (stride > kMostStride) view.refuse("found a byteStride above 252, the most glTF allows");
  result.byte_stride = static_cast<std::uint32_t>(stride);
  for (const char* const name : kMeshoptExtensions) {
    if (extension_of(view, name)) result.meshopt_extension = name;
  }
  return result;
}

GltfSparse parse_sparse(const JsonView& sparse) {
  const JsonView indices = sparse.at("indices");
  const JsonView values = sparse.at("values");
  GltfSparse result;
  result.count = sparse.at("count").whole();
  result.index_view = indices.at("bufferView").index();
  result.index_offset = indices.whole_or("byteOffset", 0);
  result.index_type = component_of(indices);
  result.value_view = values.at("bufferView").index();
  result.value_offset = values.whole_or("byteOffset", 0);
  return result;
}

GltfAccessor parse_accessor(const JsonView& accessor) {
  GltfAccessor result;
  result.view = index_of(accessor, "bufferView");
  result.byte_offset = accessor.whole_or("byteOffset", 0);
  result.type = component_of(accessor);
  result.normalized = accessor.flag_or("normalized", false);
  result.count = accessor.at("count").whole();
  result.components = components_of(accessor);
  if (const std::optional<JsonView> sparse = accessor.find("sparse")) {
    result.sparse = parse_sparse(*sparse);
  }
  return result;
}

/// The n of "TEXCOORD_n".
std::optional<std::uint32_t> texcoord_set(std::string_view name) {
  if (!name.starts_with(kTexCoordPrefix)) return std::nullopt;
  std::uint32_t set = 0;
  const char* const end = name.data() + name.size();
  const auto parsed = std::from_chars(name.data() + kTexCoordPrefix.size(), end, set);
  if (parsed.ec != std::errc{} || parsed.ptr != end) return std::nullopt;
  return set;
}

std::map<std::uint32_t, std::uint32_t> parse_texcoords(const JsonView& attributes) {
  std::map<std::uint32_t, std::uint32_t> texcoords;
  for (const std::string& name : attributes.keys()) {
    if (const auto set = texcoord_set(name)) texcoords[*set] = attributes.at(name.c_str()).index();
  }
  return texcoords;
}

GltfDraco parse_draco(const JsonView& draco) {
  const JsonView attributes = draco.at("attributes");
  GltfDraco result;
  result.view = draco.at("bufferView").index();
  result.position = index_of(attributes, "POSITION");
  result.texcoords = parse_texcoords(attributes);
  return result;
}

GltfMode parse_mode(const JsonView& primitive) {
  const std::uint64_t mode = primitive.whole_or("mode", 4);
  if (mode > 6) primitive.at("mode").refuse("expected a mode from 0 to 6");
  return static_cast<GltfMode>(mode);
}

GltfPrimitive parse_primitive(const JsonView& primitive) {
  const JsonView attributes = primitive.at("attributes");
  GltfPrimitive result;
  result.mode = parse_mode(primitive);
  result.position = index_of(attributes, "POSITION");
  result.texcoords = parse_texcoords(attributes);
  result.indices = index_of(primitive, "indices");
  result.material = index_of(primitive, "material");
  result.has_targets = primitive.elements("targets").size() != 0;
  if (const auto draco = extension_of(primitive, "KHR_draco_mesh_compression")) {
    result.draco = parse_draco(*draco);
  }
  return result;
}

GltfMesh parse_mesh(const JsonView& mesh) {
  GltfMesh primitives;
  for (const JsonView& primitive : mesh.elements("primitives")) {
    primitives.push_back(parse_primitive(primitive));
  }
  return primitives;
}

/// The rotation matrix of a unit quaternion (x, y, z, w), its columns scaled.
Affine from_parts(const std::vector<double>& t, const std::vector<double>& q,
                  const std::vector<double>& s) {
  const double x = q[0], y = q[1], z = q[2], w = q[3];
  return {{(1 - 2 * (y * y + z * z)) * s[0], 2 * (x * y + z * w) * s[0], 2 * (x * z - y * w) * s[0],
           2 * (x * y - z * w) * s[1], (1 - 2 * (x * x + z * z)) * s[1], 2 * (y * z + x * w) * s[1],
           2 * (x * z + y * w) * s[2], 2 * (y * z - x * w) * s[2], (1 - 2 * (x * x + y * y)) * s[2],
           t[0], t[1], t[2]}};
}

Affine parse_transform(const JsonView& node) {
  if (const std::optional<JsonView> matrix = node.find("matrix")) return affine_from(*matrix);
  const auto numbers_or = [&](const char* key, const std::vector<double>& otherwise) {
    const std::optional<JsonView> member = node.find(key);
    return member ? member->numbers(otherwise.size()) : otherwise;
  };
  return from_parts(numbers_or("translation", {0, 0, 0}), numbers_or("rotation", {0, 0, 0, 1}),
                    numbers_or("scale", {1, 1, 1}));
}

GltfNode parse_node(const JsonView& node) {
  GltfNode result;
  result.transform = parse_transform(node);
  result.children = indices_of(node, "children");
  result.mesh = index_of(node, "mesh");
  result.has_skin = node.find("skin").has_value();
  result.is_instanced = extension_of(node, "EXT_mesh_gpu_instancing").has_value();
  return result;
}

UvTransform parse_uv_transform(const JsonView& extension) {
  UvTransform result;
  if (const std::optional<JsonView> offset = extension.find("offset")) {
    std::ranges::copy(offset->numbers(2), result.offset);
  }
  if (const std::optional<JsonView> scale = extension.find("scale")) {
    std::ranges::copy(scale->numbers(2), result.scale);
  }
  if (const std::optional<JsonView> rotation = extension.find("rotation")) {
    result.rotation = rotation->number();
  }
  return result;
}

GltfColour parse_texture_info(const JsonView& info) {
  GltfColour result;
  result.texture = info.at("index").index();
  result.texcoord = index_of(info, "texCoord").value_or(0);
  if (const auto extension = extension_of(info, "KHR_texture_transform")) {
    result.transform = parse_uv_transform(*extension);
    result.texcoord = index_of(*extension, "texCoord").value_or(result.texcoord);
  }
  return result;
}

bool is_black(const JsonView& factor) {
  const std::vector<double> rgba = factor.numbers(4);
  return rgba[0] == 0 && rgba[1] == 0 && rgba[2] == 0;
}

/// Photogrammetry is also exported as light: with a black base colour and the photographs as the
/// emissive texture.
std::optional<JsonView> colour_texture(const JsonView& material) {
  const std::optional<JsonView> pbr = material.find("pbrMetallicRoughness");
  std::optional<JsonView> base = pbr ? pbr->find("baseColorTexture") : std::nullopt;
  if (base) return base;
  const auto glossiness = extension_of(material, "KHR_materials_pbrSpecularGlossiness");
  std::optional<JsonView> diffuse = glossiness ? glossiness->find("diffuseTexture") : std::nullopt;
  if (diffuse) return diffuse;
  const std::optional<JsonView> factor = pbr ? pbr->find("baseColorFactor") : std::nullopt;
  if (!factor || !is_black(*factor)) return std::nullopt;
  return material.find("emissiveTexture");
}

GltfMaterial parse_material(const JsonView& material) {
  const std::optional<JsonView> texture = colour_texture(material);
  if (!texture) return {};
  return {parse_texture_info(*texture)};
}

/// WebP is read, so it goes before its fallback; Basis is not, so its fallback goes first.
GltfTexture parse_texture(const JsonView& texture) {
  const auto source_by = [&](const char* name) -> std::optional<std::uint32_t> {
    const std::optional<JsonView> extension = extension_of(texture, name);
    return extension ? index_of(*extension, "source") : std::nullopt;
  };
  if (const auto image = source_by("EXT_texture_webp")) return {image, false};
  if (const auto image = index_of(texture, "source")) return {image, false};
  if (const auto image = source_by("EXT_texture_avif")) return {image, false};
  if (const auto image = source_by("MSFT_texture_dds")) return {image, false};
  if (const auto image = source_by("KHR_texture_basisu")) return {image, true};
  return {};
}

GltfImage parse_image(const JsonView& image) {
  GltfImage result;
  result.uri = parse_uri(image);
  result.view = index_of(image, "bufferView");
  result.name = image.text_or("name", "");
  result.is_basis = image.text_or("mimeType", "") == "image/ktx2";
  return result;
}

Affine parse_rtc(const JsonView& document) {
  const std::optional<JsonView> rtc = extension_of(document, "CESIUM_RTC");
  if (!rtc) return {};
  const std::vector<double> center = rtc->at("center").numbers(3);
  return Affine::translation(center[0], center[1], center[2]);
}

void check_version(const JsonView& document) {
  if (!document.is_object() || !document.find("asset")) {
    document.refuse("found no \"asset\", so this is no glTF; give a glTF 2.0");
  }
  const JsonView version = document.at("asset").at("version");
  if (version.text().starts_with("2.")) return;
  version.refuse("found glTF " + shown_uri(version.text()) +
                 ", expected 2.0; convert the model, as with gltf-pipeline");
}

void check_extensions(const JsonView& document) {
  for (const JsonView& name : document.elements("extensionsRequired")) {
    if (is_harmless_extension(name.text())) continue;
    name.refuse("the model requires the extension " + shown_uri(name.text()) +
                ", which is not known here and may change its geometry; export it without");
  }
}

template <class T>
std::vector<T> parse_all(const JsonView& document, const char* key, T (*parse)(const JsonView&)) {
  std::vector<T> result;
  for (const JsonView& element : document.elements(key)) result.push_back(parse(element));
  return result;
}

std::vector<std::uint32_t> parse_scene(const JsonView& scene) {
  return indices_of(scene, "nodes");
}

}  // namespace

std::uint32_t component_bytes(GltfComponent type) {
  switch (type) {
    case GltfComponent::kByte:
    case GltfComponent::kUnsignedByte:
      return 1;
    case GltfComponent::kShort:
    case GltfComponent::kUnsignedShort:
      return 2;
    case GltfComponent::kUnsignedInt:
    case GltfComponent::kFloat:
      break;
  }
  return 4;
}

bool is_gltf_member(std::string_view key) {
  return key.starts_with(kTexCoordPrefix) || std::ranges::binary_search(kMembers, key);
}

GltfModel parse_gltf(const nlohmann::json& json, const std::string& path) {
  const JsonView document(json, path);
  check_version(document);
  check_extensions(document);
  GltfModel model;
  model.buffers = parse_all(document, "buffers", parse_buffer);
  model.views = parse_all(document, "bufferViews", parse_view);
  model.accessors = parse_all(document, "accessors", parse_accessor);
  model.meshes = parse_all(document, "meshes", parse_mesh);
  model.nodes = parse_all(document, "nodes", parse_node);
  model.scenes = parse_all(document, "scenes", parse_scene);
  model.default_scene = index_of(document, "scene");
  model.materials = parse_all(document, "materials", parse_material);
  model.textures = parse_all(document, "textures", parse_texture);
  model.images = parse_all(document, "images", parse_image);
  model.rtc = parse_rtc(document);
  return model;
}

}  // namespace atlasgauge
