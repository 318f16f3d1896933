#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "bench/answers.hpp"

namespace atlasgauge {

/// The texels of one mip level that a triangle covers.
struct LevelCover {
  std::uint64_t covered = 0;
  std::uint64_t bilinear = 0;  ///< with their neighbours
  std::uint64_t boundary = 0;  ///< of the covered, those on the rim or beside an uncovered one
};

/// All texels of a level of side x side.
LevelCover whole_cover(std::uint64_t side);

/// A square of s x s texels that is two texels or more from the rim and from any other.
LevelCover square_cover(std::uint64_t s);

/// A right triangle in the lower left corner with legs of s texels, shorter than the level. Its
/// hypotenuse runs through centres, which it does not cover.
LevelCover corner_cover(std::uint64_t s);

/// Only the texels of the diagonal.
LevelCover diagonal_cover(std::uint64_t side);

/// The texels below the diagonal and those on it.
LevelCover half_cover(std::uint64_t side);

/// Answers `texture_N` of a square texture: on each level, cover_of(side, level) is what `count`
/// faces cover alike. Nothing clashes.
template <class CoverOf>
void answer_levels(std::uint64_t texture, std::uint64_t side, std::uint64_t count, CoverOf cover_of,
                   Answers& answers) {
  nlohmann::json levels = nlohmann::json::array();
  for (unsigned level = 0; side >> level > 0; ++level) {
    const LevelCover cover = cover_of(side >> level, level);
    levels.push_back({{"rw", side >> level},
                      {"rh", side >> level},
                      {"totalTexels", count * cover.covered},
                      {"totalTexels_bilinear", cover.bilinear},
                      {"overwrittenTexels", count > 1 ? cover.covered : 0},
                      {"lostTexels", (count - 1) * cover.covered},
                      {"boundaryTexels", cover.boundary},
                      {"texelClashes", 0}});
  }
  answers.values["texture_" + std::to_string(texture)] = std::move(levels);
}

}  // namespace atlasgauge
