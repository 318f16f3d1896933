#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "tests/support/oracle/levels.hpp"

// Where the atlas is cut, and what the colours on both sides of the cut are.
namespace atlasgauge::oracle {

// The edge as one of its faces has it, from the smaller to the larger welded vertex.
struct SeamSide {
  EdgeUse use;
  std::optional<int64_t> slot;
  std::array<std::optional<Uv>, 2> uvs;  // as in the file
  std::array<Texel, 2> texels;           // if sampled
};

struct Seam {
  EdgeKey vertices;
  double length_3d = 0;
  std::array<SeamSide, 2> sides;
  bool sampled = false;
  int64_t samples = 0;
  std::optional<double> discrepancy;           // none without samples
  std::optional<double> texmetro_discrepancy;  // by TexMetro's samples; none without any
};

// In ascending order of vertices; sides in ascending order of slot and UVs. Sampled as TexMetro
// does, too, if that is asked for.
std::vector<Seam> find_seams(const Analysis& analysis, bool texmetro);

}  // namespace atlasgauge::oracle
