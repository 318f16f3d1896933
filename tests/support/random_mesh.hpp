#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>

// Small random models with every defect that the specification speaks of, mixed by the seed. Most
// have coordinates on a coarse dyadic lattice, where coincidences and exact equalities abound; many
// have UVs on the texel borders, texel centres or raster units of their textures, whose sizes are
// small and often odd.
namespace atlasgauge::oracle {

struct RandomMeshOptions {
  int min_faces = 10;
  int max_faces = 200;         // defects may add a few
  double defect_chance = 0.3;  // that a kind of defect occurs in a model; calm ones have none
  // An OBJ without an mtllib line finds the MTL only when both files have the same stem.
  std::string mtl_name = "random.mtl";
};

struct RandomModel {
  std::string obj;
  std::string mtl;
  // The images beside the MTL and their sizes. One that the MTL names but that is absent here is
  // missing.
  std::map<std::string, std::pair<uint32_t, uint32_t>> images;
  // To be measured with that size for what has none.
  std::optional<std::pair<uint32_t, uint32_t>> size_option;
  // UVs lie so far from each other that seams may have billions of samples: not to be measured with
  // images that can be decoded.
  bool reaches_long = false;
};

// The same seed gives the same model everywhere.
RandomModel random_model(uint64_t seed, const RandomMeshOptions& options = {});

std::string random_obj(uint64_t seed, const RandomMeshOptions& options = {});

}  // namespace atlasgauge::oracle
