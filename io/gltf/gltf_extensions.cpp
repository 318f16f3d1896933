#include "io/gltf/gltf_extensions.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace atlasgauge {
namespace {

/// Read here, or refused where they are used.
constexpr std::array<std::string_view, 10> kRead = {"KHR_draco_mesh_compression",
                                                    "KHR_mesh_quantization",
                                                    "KHR_texture_transform",
                                                    "KHR_texture_basisu",
                                                    "EXT_texture_webp",
                                                    "EXT_meshopt_compression",
                                                    "KHR_meshopt_compression",
                                                    "EXT_mesh_gpu_instancing",
                                                    "CESIUM_RTC",
                                                    "EXT_texture_avif"};

/// Light, animation, names, and meaning.
constexpr std::array<std::string_view, 17> kIgnored = {
    "KHR_lights_punctual",      "KHR_animation_pointer", "KHR_xmp",
    "KHR_xmp_json_ld",          "KHR_node_visibility",   "KHR_node_hoverability",
    "KHR_node_selectability",   "KHR_interactivity",     "KHR_audio_emitter",
    "KHR_physics_rigid_bodies", "EXT_mesh_features",     "EXT_instance_features",
    "EXT_structural_metadata",  "EXT_feature_metadata",  "EXT_lights_image_based",
    "CESIUM_primitive_outline", "MSFT_texture_dds"};

}  // namespace

bool is_harmless_extension(const std::string& name) {
  if (name.starts_with("KHR_materials_") || name.starts_with("EXT_materials_")) return true;
  return std::ranges::find(kRead, name) != kRead.end() ||
         std::ranges::find(kIgnored, name) != kIgnored.end();
}

}  // namespace atlasgauge
