#include "stream/raster/atlas_regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "io/error.hpp"

namespace atlasgauge {
namespace {

/// Of a square's side, that its triangles may lie outside.
constexpr double kMostReach = 1.0 / 8;

/// From the border of a square to the centres of the texels in its halo, and the rounding to 1/256
/// texel.
constexpr double kHalo = 0.5 + 1.0 / 256;

/// How far around squares of `side` texels triangles matter, in texels of the first level along one
/// axis; `down` levels below, the size of that level is `size` >> `down`.
///
/// With d = 2^down, square c has the texels from floor(c side / d) on. These begin at most d texels
/// of the first level before c side, and not before where d divides the side. Of the next
/// square's first texel i, the left border lies at i size / (size >> down) texels of the first
/// level, which is at most size mod d beyond (c + 1) side.
double axis_reach(std::int64_t size, std::int64_t side, std::uint32_t down) {
  const std::int64_t step = std::int64_t{1} << down;
  const double texel = static_cast<double>(size) / static_cast<double>(size >> down);
  const std::int64_t before = side % step == 0 ? 0 : step;
  return kHalo * texel + static_cast<double>(std::max(before, size % step));
}

SquareGrid::Reach level_reach(const LevelSize& first, std::int64_t side, std::uint32_t down) {
  return {axis_reach(first.width, side, down), axis_reach(first.height, side, down)};
}

}  // namespace

TexelRect Region::rect(std::uint32_t level, const LevelSize& size) const {
  const std::uint32_t down = level - levels.first;
  return {column * side >> down, row * side >> down,
          is_last_column ? size.width : (column + 1) * side >> down,
          is_last_row ? size.height : (row + 1) * side >> down};
}

std::vector<LevelRange> AtlasRegions::cut_levels(const MipLevels& levels, std::int64_t side) {
  const std::uint32_t end = levels.first_within(side);
  if (end == 0) return {};
  std::vector<LevelRange> ranges{{0, 1}};
  for (std::uint32_t level = 1; level < end; ++level) {
    const std::uint32_t first = ranges.back().first;
    const auto [x, y] = level_reach(levels.size(first), side, level - first);
    if (std::max(x, y) > kMostReach * static_cast<double>(side)) ranges.push_back({level, level});
    ranges.back().end = level + 1;
  }
  return ranges;
}

SquareGrid::Reach AtlasRegions::reach(const MipLevels& levels, LevelRange range,
                                      std::int64_t side) {
  SquareGrid::Reach most{0, 0};
  for (std::uint32_t level = range.first; level < range.end; ++level) {
    const auto [x, y] = level_reach(levels.size(range.first), side, level - range.first);
    most = {std::max(most.x, x), std::max(most.y, y)};
  }
  return most;
}

std::uint64_t AtlasRegions::memory_bytes(const SlotFrames& frames, std::int64_t side) {
  std::uint64_t tiers = 0;
  for (const SlotFrame& frame : frames.all()) {
    if (frame.has_size) tiers += cut_levels(levels_of(frame), side).size();
  }
  return 2 * tiers * sizeof(Tier) + (frames.all().size() + 1) * sizeof(Firsts);  // 2: as it grows
}

AtlasRegions::AtlasRegions(const SlotFrames& frames, std::int64_t side)
    : frames_(frames), side_(side) {
  firsts_.reserve(frames.all().size() + 1);
  std::uint64_t regions = 0;
  const auto start_slot = [&] {
    firsts_.push_back(
        {static_cast<std::uint32_t>(regions), static_cast<std::uint32_t>(tiers_.size())});
  };
  for (const SlotFrame& frame : frames.all()) {
    start_slot();
    if (frame.has_size) add_tiers(frame, regions);
  }
  start_slot();
}

void AtlasRegions::add_tiers(const SlotFrame& frame, std::uint64_t& regions) {
  const MipLevels levels = levels_of(frame);
  const std::vector<LevelRange> ranges = cut_levels(levels, side_);
  most_tiers_ = std::max(most_tiers_, ranges.size());
  if (ranges.empty()) ++regions;
  for (const LevelRange& range : ranges) {
    const LevelSize size = levels.size(range.first);
    const SquareGrid squares(size, side_, reach(levels, range, side_));
    tiers_.push_back({range, static_cast<std::uint32_t>(regions), at_level(frame, size), squares});
    regions += static_cast<std::uint64_t>(squares.columns() * squares.rows());
  }
  if (regions <= std::numeric_limits<std::int32_t>::max()) return;
  throw Error(ErrorKind::kResource,
              fmt::format("textures of {} x {} texels and others have too many tiles; give more "
                          "memory with --memory, or smaller textures",
                          frame.width, frame.height));
}

Region AtlasRegions::region(std::uint32_t number) const {
  const auto next = std::upper_bound(
      firsts_.begin(), firsts_.end(), number,
      [](std::uint32_t region, const Firsts& firsts) { return region < firsts.region; });
  const SlotId slot{static_cast<std::uint32_t>(next - firsts_.begin() - 1)};
  const std::span<const Tier> tiers = tiers_of(slot);
  if (tiers.empty())
    return {slot, {0, levels_of(frames_.of(slot)).count()}, side_, 0, 0, true, true};
  std::size_t own = tiers.size() - 1;
  while (tiers[own].first_region > number) --own;
  const Tier& tier = tiers[own];
  const std::int64_t place = number - tier.first_region;
  const std::int64_t column = place % tier.squares.columns();
  const std::int64_t row = place / tier.squares.columns();
  return {slot,
          tier.levels,
          side_,
          column,
          row,
          column == tier.squares.columns() - 1,
          row == tier.squares.rows() - 1};
}

LevelRange AtlasRegions::whole_levels(SlotId slot) const {
  const std::uint32_t end = levels_of(frames_.of(slot)).count();
  const std::span<const Tier> tiers = tiers_of(slot);
  return {tiers.empty() ? end : tiers.back().levels.end, end};
}

}  // namespace atlasgauge
