#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "bench/answers.hpp"

namespace atlasgauge {

/// The numbers that a closed form gives for a model of one virtual texture of 1x1; every other
/// answer follows from them. An area or length that is not given is not answered.
struct Shape {
  std::uint64_t faces = 0;  ///< all triangles: those of the four next kinds, too
  std::uint64_t degenerate = 0;
  std::uint64_t nonfinite = 0;
  std::uint64_t duplicates = 0;
  std::uint64_t zero_area = 0;
  std::uint64_t invalid = 0;

  std::uint64_t positions = 0;
  std::uint64_t unreferenced = 0;
  std::uint64_t coincident = 0;  ///< positions minus distinct ones

  std::uint64_t edges = 0;
  std::uint64_t boundary_edges = 0;
  std::uint64_t nonmanifold_edges = 0;
  std::uint64_t nonmanifold_vertices = 0;
  std::uint64_t components = 0;
  std::uint64_t largest_component = 0;
  std::uint64_t boundary_components = 0;
  bool oriented = true;
  bool orientable = true;

  std::uint64_t charts = 0;
  std::uint64_t null_charts = 0;
  std::uint64_t nonorientable_charts = 0;
  std::uint64_t uv_edges = 0;
  std::uint64_t uv_boundary_edges = 0;
  std::uint64_t seam_edges = 0;  ///< none sampled: there is no image
  std::uint64_t folds = 0;
  std::uint64_t unmapped = 0;
  std::uint64_t outside = 0;  ///< of [0, 1]²

  std::optional<double> area, boundary_len, area_uv, boundary_len_uv, seam_len;
  double longest_side = 0;
  /// Distributions that have one value on all faces.
  std::map<std::string, double> uniform;
};

/// Wholes and halves are answered exactly, since they are sums of such.
Answers answers_of(const Shape& shape);

}  // namespace atlasgauge
