#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "stream/mesh/triangle.hpp"
#include "stream/raster/mip_levels.hpp"
#include "stream/raster/square_grid.hpp"
#include "stream/raster/texel_tile.hpp"

namespace atlasgauge {

/// Levels [first, end).
struct LevelRange {
  std::uint32_t first = 0, end = 0;
};

/// The texels of some levels of a slot that are drawn together: those that lie over one square of
/// the first of these levels.
struct Region {
  SlotId slot;
  LevelRange levels;
  std::int64_t side;         ///< of the square, in texels of the first level
  std::int64_t column, row;  ///< of the square
  bool is_last_column, is_last_row;

  /// Its texels of a level of that size; may be empty.
  TexelRect rect(std::uint32_t level, const LevelSize& size) const;
};

/// Cuts the levels of all slots into regions, so that a triangle has to go to few of them, and with
/// it to all levels: it is copied once for a region, not once for a level. Regions are numbered
/// slot by slot.
///
/// A slot that fits a square of `side` texels is one region. Of a larger slot the levels that fit
/// are not in any region: they are to be drawn whole, each triangle once. The others are cut over
/// squares of the largest level. To a square triangles matter as far around as a texel of its
/// coarsest level reaches; where that would be much of the square, there are several tiers of
/// levels, each cut for itself.
class AtlasRegions {
 public:
  static std::uint64_t memory_bytes(const SlotFrames& frames, std::int64_t side);

  /// The frames outlive it. Throws Error(kResource) for more regions than can be numbered.
  AtlasRegions(const SlotFrames& frames, std::int64_t side);

  std::uint32_t count() const { return firsts_.back().region; }
  std::size_t slots() const { return firsts_.size() - 1; }
  /// Of the slot that has most.
  std::size_t most_tiers() const { return most_tiers_; }
  Region region(std::uint32_t number) const;
  /// The levels of a slot that are drawn whole.
  LevelRange whole_levels(SlotId slot) const;

  /// Calls use(region) for every region that the triangle may touch, halos of one texel included:
  /// at least one if it covers anything. The slot has a size.
  template <class Use>
  void visit_touched(SlotId slot, const TexCoord (&uv)[3], Use use) const;

 private:
  /// Levels of a large slot that are cut together.
  struct Tier {
    LevelRange levels;
    std::uint32_t first_region;
    SlotFrame frame;  ///< at the first level
    SquareGrid squares;
  };
  /// What a slot has from here on; small ones have one region and no tier.
  struct Firsts {
    std::uint32_t region, tier;
  };

  static std::vector<LevelRange> cut_levels(const MipLevels& levels, std::int64_t side);
  static SquareGrid::Reach reach(const MipLevels& levels, LevelRange range, std::int64_t side);
  void add_tiers(const SlotFrame& frame, std::uint64_t& regions);
  std::span<const Tier> tiers_of(SlotId slot) const {
    const std::uint32_t first = firsts_[raw(slot)].tier;
    return std::span(tiers_).subspan(first, firsts_[raw(slot) + 1].tier - first);
  }

  const SlotFrames& frames_;
  std::int64_t side_;
  std::vector<Firsts> firsts_;  ///< by slot, and one more
  std::vector<Tier> tiers_;     ///< by region
  std::size_t most_tiers_ = 1;
};

/// Whether a triangle may cover something of a texture.
inline bool touches_texture(const TexCoord (&uv)[3], const SlotFrame& frame) {
  const auto touches = [](float a, float b, float c, double shift) {
    return static_cast<double>(std::max({a, b, c})) + shift > 0 &&
           static_cast<double>(std::min({a, b, c})) + shift < 1;
  };
  return touches(uv[0].u, uv[1].u, uv[2].u, frame.shift_u) &&
         touches(uv[0].v, uv[1].v, uv[2].v, frame.shift_v);
}

template <class Use>
void AtlasRegions::visit_touched(SlotId slot, const TexCoord (&uv)[3], Use use) const {
  const std::span<const Tier> tiers = tiers_of(slot);
  if (tiers.empty() && touches_texture(uv, frames_.of(slot))) use(firsts_[raw(slot)].region);
  for (const Tier& tier : tiers) {
    const Texel corner[3] = {tier.frame.texel(uv[0]), tier.frame.texel(uv[1]),
                             tier.frame.texel(uv[2])};
    tier.squares.visit_touched(corner, [&](std::int64_t column, std::int64_t row) {
      use(tier.first_region + static_cast<std::uint32_t>(row * tier.squares.columns() + column));
    });
  }
}

}  // namespace atlasgauge
