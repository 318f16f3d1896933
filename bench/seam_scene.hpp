#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/answers.hpp"

namespace atlasgauge {

enum class SceneContent { kPhoto, kConstant };

/// What scene of seams to make. Equal options give equal bytes.
struct SeamSceneOptions {
  std::string name = "seams";
  std::uint64_t edges = 300'000;
  std::uint32_t textures = 40;
  std::uint32_t texture_size_texels = 4096;
  double length_texels =
      20;  ///< of the sides of seams on average; they spread from 0.5 to 1.5 of it
  std::string image_format = "jpg";  ///< jpg, png or tif
  SceneContent content = SceneContent::kPhoto;
  std::uint64_t seed = 1;
};

/// The triangle on one side of a seam edge: UVs at both ends of the edge and at the third corner.
struct SceneSide {
  std::uint32_t texture;
  std::array<std::array<float, 2>, 3> uv;
};

/// Two triangles with an edge in common and a place of their own in space.
struct SceneEdge {
  std::uint64_t column, row;  ///< of a lattice
  std::uint64_t length_3d;    ///< model units
  bool own_vertices;          ///< two vertices for each end: the edge needs a weld
  std::array<SceneSide, 2> sides;
};

/// Seam edges between random places of random textures, so that no order of the edges or textures
/// brings near in memory what belongs together. Every edge is a function of its index.
class SeamScene {
 public:
  /// Throws Error(kUsage) when the options make no scene.
  explicit SeamScene(const SeamSceneOptions& options);

  const SeamSceneOptions& options() const { return options_; }
  std::uint64_t faces() const { return 2 * options_.edges; }
  std::uint64_t vertices() const { return first_vertex(options_.edges); }

  SceneEdge edge(std::uint64_t index) const;
  /// Every second edge has its own vertices: six instead of four.
  std::uint64_t first_vertex(std::uint64_t edge) const { return 4 * edge + 2 * (edge / 2); }

  /// The colour of a texture of constant content.
  std::array<std::uint8_t, 3> colour(std::uint32_t texture) const;
  /// Names of the images beside the OBJ.
  std::vector<std::string> texture_names() const;
  /// How many pairs of colours there are to compare. Looks at all edges.
  std::uint64_t sample_pairs() const;

 private:
  SeamSceneOptions options_;
  std::uint64_t lattice_columns_;
};

/// With constant content the discrepancies are those of pairs of colours; without, they are not
/// among the answers.
Answers seam_scene_answers(const SeamScene& scene);

/// Writes NAME.obj, NAME.mtl, the images and NAME.answers.json into a directory.
void write_seam_scene(const SeamScene& scene, const std::string& directory, std::size_t threads);

}  // namespace atlasgauge
