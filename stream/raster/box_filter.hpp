#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "io/mesh_batch.hpp"
#include "stream/mesh/triangle.hpp"
#include "stream/raster/tile_pyramid.hpp"

namespace atlasgauge {

/// Tells which of some triangles may cover a texel of a tile: those in whose boxes centres of its
/// texels lie. On most of the higher levels most triangles lie between the centres, and this costs
/// less than to snap a corner.
class BoxFilter {
 public:
  /// For so many triangles at a time.
  explicit BoxFilter(std::size_t most);

  void clear();
  /// A triangle of the slot of this frame.
  void add(const TexCoord (&uv)[3], const SlotFrame& frame);
  /// Leaves out what was added as the i-th, from 0.
  void remove(std::size_t i) { high_u_[i] = low_u_[i]; }

  /// In order, by when they were added. Valid until the next call.
  std::span<const std::uint32_t> choose(const LevelTile& tile);

 private:
  std::size_t count_ = 0;
  /// Boxes by triangle, in textures from the origin of the slot, and the box of all.
  std::vector<double> low_u_, high_u_, low_v_, high_v_;
  double all_low_u_ = 0, all_high_u_ = 0, all_low_v_ = 0, all_high_v_ = 0;
  std::vector<double> common_;
  std::vector<std::uint32_t> chosen_;
};

}  // namespace atlasgauge
