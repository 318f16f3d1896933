#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/gltf_bytes.hpp"

namespace atlasgauge {

/// Writes a glTF piece by piece. Everything may be changed in `document` afterwards.
class GltfBuilder {
 public:
  static constexpr int kByte = 5120, kUnsignedByte = 5121, kShort = 5122, kUnsignedShort = 5123,
                       kUnsignedInt = 5125, kFloat = 5126;

  GltfBuilder() { document["asset"]["version"] = "2.0"; }

  /// Returns the number of what it adds, as all below.
  std::size_t view(const std::string& bytes, int stride = 0) {
    nlohmann::json added = {
        {"buffer", 0}, {"byteOffset", binary.size()}, {"byteLength", bytes.size()}};
    if (stride != 0) added["byteStride"] = stride;
    binary += padded(bytes, '\0');
    return add("bufferViews", added);
  }

  std::size_t accessor(const std::string& bytes, int type, const char* shape, std::size_t count,
                       bool normalized = false) {
    nlohmann::json added = {
        {"bufferView", view(bytes)}, {"componentType", type}, {"type", shape}, {"count", count}};
    if (normalized) added["normalized"] = true;
    return add("accessors", added);
  }

  std::size_t positions(const std::vector<float>& values) {
    return accessor(floats(values), kFloat, "VEC3", values.size() / 3);
  }
  std::size_t texcoords(const std::vector<float>& values) {
    return accessor(floats(values), kFloat, "VEC2", values.size() / 2);
  }
  std::size_t indices(const std::vector<std::uint8_t>& values) {
    return accessor({values.begin(), values.end()}, kUnsignedByte, "SCALAR", values.size());
  }

  std::size_t mesh(const nlohmann::json& primitive) {
    return add("meshes", {{"primitives", nlohmann::json::array({primitive})}});
  }

  std::size_t add(const char* array, const nlohmann::json& element) {
    document[array].push_back(element);
    return document[array].size() - 1;
  }

  /// A mesh under a node of its own: all that simple tests need.
  void show(const nlohmann::json& primitive) { add("nodes", {{"mesh", mesh(primitive)}}); }

  std::string glb() {
    if (!binary.empty() && !document.contains("buffers")) {
      document["buffers"] = {{{"byteLength", binary.size()}}};
    }
    return make_glb(document.dump(), binary);
  }

  static std::string floats(const std::vector<float>& values) {
    std::string bytes;
    for (const float value : values) bytes += bytes_of(value);
    return bytes;
  }

  nlohmann::json document;
  std::string binary;
};

/// The triangle (0,0,0), (1,0,0), (0,1,0), by POSITION alone.
inline GltfBuilder one_triangle() {
  GltfBuilder gltf;
  gltf.show({{"attributes", {{"POSITION", gltf.positions({0, 0, 0, 1, 0, 0, 0, 1, 0})}}}});
  return gltf;
}

}  // namespace atlasgauge
