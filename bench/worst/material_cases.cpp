#include <filesystem>
#include <numbers>

#include "bench/worst/families.hpp"
#include "bench/worst/levels.hpp"
#include "bench/worst/strip.hpp"

namespace atlasgauge {
namespace {

constexpr std::uint64_t kSide = 16;  // texels of an image
constexpr std::uint64_t kFacesOfMaterial = 20;

std::uint64_t materials_of(std::uint64_t size) {
  return size / kFacesOfMaterial;
}

std::string image_name(std::uint64_t material, bool shared) {
  return shared ? "image.ppm" : "image_" + std::to_string(material) + ".ppm";
}

void write_image(const std::filesystem::path& path) {
  TextFile image(path.string());
  image.put("P3\n16 16\n255\n");
  for (std::uint64_t i = 0; i < kSide * kSide; ++i) image.put("10 20 30\n");
  image.close();
}

void write_library(std::uint64_t materials, bool shared, const std::string& stem) {
  TextFile mtl(stem + ".mtl");
  for (std::uint64_t i = 0; i < materials; ++i) {
    mtl.put("newmtl m");
    mtl.put(i);
    mtl.put("\nmap_Kd " + image_name(i, shared) + "\n");
  }
  mtl.close();
}

/// Materials take turns after twenty faces. Of their own images only the first exists, so that the
/// program has the work of missing ones and the memory of reading one.
void write_materials(std::uint64_t size, bool shared, const std::string& stem) {
  const std::filesystem::path path(stem);
  const std::uint64_t materials = materials_of(size);
  write_image(path.parent_path() / image_name(0, shared));
  write_library(materials, shared, stem);
  const Strip strip{.faces = materials * kFacesOfMaterial};
  ObjFile obj(stem);
  obj.put("mtllib " + path.filename().string() + ".mtl\n");
  put_strip_vertices(strip, obj);
  put_strip_texcoords(strip, obj);
  for (std::uint64_t i = 0; i < strip.faces; ++i) {
    if (i % kFacesOfMaterial == 0) {
      obj.put("usemtl m");
      obj.put(i / kFacesOfMaterial);
      obj.put('\n');
    }
    obj.put_face(strip.face(i), strip.face(i));
  }
  obj.close();
}

Shape textured_shape(std::uint64_t size) {
  Shape shape = open_strip_shape(materials_of(size) * kFacesOfMaterial);
  shape.area_uv = *shape.area_uv * kSide * kSide;
  shape.boundary_len_uv = *shape.boundary_len_uv * kSide;
  shape.uniform["texel_density"] *= kSide;
  return shape;
}

/// A strip is shifted so that it begins with its slanting side on the texture.
void answer_texels(std::uint64_t textures, Answers& answers) {
  for (std::uint64_t i = 0; i < textures; ++i) {
    answer_levels(
        i, kSide, 1, [](auto side, unsigned) { return half_cover(side); }, answers);
  }
  const auto covered = static_cast<double>(half_cover(kSide).covered);
  answers.values["occupancy"] = covered / (kSide * kSide);
  answers.values["overlap_within_chart_texels"] = 0;
  answers.values["overlap_between_charts_texels"] = 0;
}

/// A strip is a chart for every material. Each is shifted by a whole number of textures, which
/// changes no length.
Answers own_images_answers(std::uint64_t size) {
  const std::uint64_t materials = materials_of(size);
  const auto seams = static_cast<double>(materials - 1);
  Shape shape = textured_shape(size);
  shape.charts = materials;
  shape.seam_edges = materials - 1;
  shape.seam_len = 5 * seams;
  shape.uv_edges += shape.seam_edges;
  shape.uv_boundary_edges += 2 * shape.seam_edges;
  shape.boundary_len_uv = *shape.boundary_len_uv + 2 * seams * kSide * std::numbers::sqrt2;
  Answers answers = answers_of(shape);
  nlohmann::json names = nlohmann::json::array();
  for (std::uint64_t i = 0; i < materials; ++i) names.push_back(image_name(i, false));
  answers.values["ntex"] = materials;
  answers.values["textures"] = std::move(names);
  answer_texels(materials, answers);
  return answers;
}

Answers same_image_answers(std::uint64_t size) {
  Answers answers = answers_of(textured_shape(size));
  answers.values["textures"] = {image_name(0, true)};
  answer_texels(1, answers);
  return answers;
}

}  // namespace

std::vector<WorstCase> material_cases() {
  return {
      {"materials", "a material for every 20 faces, each with an image of its own", "faces",
       [](std::uint64_t size, const std::string& stem) { write_materials(size, false, stem); },
       own_images_answers, ImageSize{16, 16}},
      {"materials_same_image", "a material for every 20 faces, all with one image", "faces",
       [](std::uint64_t size, const std::string& stem) { write_materials(size, true, stem); },
       same_image_answers, ImageSize{16, 16}},
  };
}

}  // namespace atlasgauge
