#include "stream/raster/atlas_raster.hpp"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "stream/engine/block_visit.hpp"
#include "stream/engine/keyed_groups.hpp"
#include "stream/raster/atlas_regions.hpp"
#include "stream/raster/level_parts.hpp"
#include "stream/raster/mip_levels.hpp"
#include "stream/raster/pyramid_raster.hpp"
#include "stream/raster/region_bins.hpp"
#include "stream/raster/tile_pyramid.hpp"
#include "stream/raster/whole_levels.hpp"

namespace atlasgauge {
namespace {

std::int64_t largest_side(const SlotFrames& frames) {
  double side = 1;
  for (const SlotFrame& frame : frames.all()) side = std::max({side, frame.width, frame.height});
  return static_cast<std::int64_t>(side);
}

std::int64_t tile_size(const Engine& engine, const SlotFrames& frames, const RasterPlan& plan) {
  if (plan.tile_size > 0) return plan.tile_size;
  return choose_tile_size(engine.budget.free_bytes(), engine.workers.count(),
                          std::min(plan.largest_tile, largest_side(frames)));
}

/// Of the levels of large slots that fit a tile.
std::int64_t largest_whole_side(const SlotFrames& frames, std::int64_t tile_side) {
  std::int64_t side = 0;
  for (const SlotFrame& frame : frames.all()) {
    if (!frame.has_size) continue;
    const MipLevels levels = levels_of(frame);
    const std::uint32_t first = levels.first_within(tile_side);
    if (first == 0 || first == levels.count()) continue;
    side = std::max({side, levels.size(first).width, levels.size(first).height});
  }
  return side;
}

/// The tiles of every worker, and what it writes through.
std::uint64_t drawing_bytes(const Engine& engine, const SlotFrames& frames, std::int64_t side) {
  const std::uint64_t tiles_bytes = pyramid_bytes(std::min(side, largest_side(frames))) +
                                    pyramid_bytes(largest_whole_side(frames, side));
  return engine.workers.count() * (tiles_bytes + engine.block_bytes()) + engine.block_bytes();
}

/// Draws regions, all workers at once.
class RegionsRaster {
 public:
  RegionsRaster(const Engine& engine, const SlotFrames& frames, const RasterPlan& plan,
                const AtlasRegions& regions, const std::vector<std::uint32_t>& triangles,
                std::uint64_t faces, StageLog::Stage& stage)
      : engine_(engine),
        frames_(frames),
        regions_(regions),
        parts_(engine.scratch),
        whole_(engine, frames, regions, triangles, parts_),
        faces_(faces),
        stage_(stage) {
    for (std::size_t i = 0; i < engine.workers.count(); ++i) {
      painters_.emplace_back(plan.make(), parts_);
    }
  }

  void draw(KeyedGroups<RegionTriangle>::Buckets bins) {
    KeyedGroups<RegionTriangle> groups(
        engine_,
        [&](std::size_t worker, std::span<RegionTriangle> triangles) {
          const Region region = regions_.region(triangles[0].key());
          start(worker, region);
          draw(worker, region, triangles);
          count(worker, region);
        },
        [&](std::uint32_t region, Spill<RegionTriangle> triangles) {
          draw_hot(regions_.region(region), std::move(triangles));
        });
    groups.process(std::move(bins));
    whole_.finish();
  }

  RasterWork work() const {
    RasterWork work;
    work.tiles = whole_.counted();
    for (const Painter& painter : painters_) {
      work.tiles += painter.regions;
      work.triangles.merge(painter.raster.tally());
    }
    return work;
  }

  Spill<LevelPart> finish() {
    for (Painter& painter : painters_) painter.parts.flush();
    return parts_.finish();
  }

 private:
  /// What one worker draws with.
  struct Painter {
    Painter(std::unique_ptr<Raster> own_raster, LevelParts& all_parts)
        : raster(std::move(own_raster)), parts(all_parts) {}
    PyramidRaster raster;
    TilePyramid tiles;
    LevelParts::Writer parts;
    std::uint64_t regions = 0;
  };

  void start(std::size_t worker, const Region& region) {
    TilePyramid& tiles = painters_[worker].tiles;
    tiles.clear();
    const MipLevels levels = levels_of(frames_.of(region.slot));
    for (std::uint32_t level = region.levels.first; level < region.levels.end; ++level) {
      const TexelRect rect = region.rect(level, levels.size(level));
      if (!rect.empty()) tiles.add(level, levels.size(level), rect);
    }
  }

  void draw(std::size_t worker, const Region& region, std::span<const RegionTriangle> triangles) {
    Painter& painter = painters_[worker];
    TilePyramid& whole = whole_.tiles_of(worker, region.slot);
    const std::uint64_t drawn =
        painter.raster.draw(triangles, frames_.of(region.slot), painter.tiles, whole);
    whole_.add(worker, drawn);
    const std::uint64_t drawn_by_all = drawn_.fetch_add(drawn) + drawn;
    if (worker == 0) stage_.progress(faces_ + drawn_by_all);
  }

  void count(std::size_t worker, const Region& region) {
    Painter& painter = painters_[worker];
    count_tiles(region.slot, painter.tiles, painter.parts);
    ++painter.regions;
  }

  /// A region with more triangles than memory: every worker draws some, in tiles of its own.
  void draw_hot(const Region& region, Spill<RegionTriangle> triangles) {
    for (std::size_t worker = 0; worker < painters_.size(); ++worker) start(worker, region);
    visit_blocks(engine_, triangles, [&](std::size_t worker, std::size_t block, auto some) {
      draw(worker, region, some);
      triangles.free_block(block);
    });
    for (std::size_t i = 1; i < painters_.size(); ++i) {
      painters_[0].tiles.merge(painters_[i].tiles);
    }
    count(0, region);
  }

  const Engine& engine_;
  const SlotFrames& frames_;
  const AtlasRegions& regions_;
  LevelParts parts_;
  WholeLevels whole_;
  const std::uint64_t faces_;
  StageLog::Stage& stage_;  ///< whose work is to distribute the faces, and to draw them
  std::atomic<std::uint64_t> drawn_ = 0;
  std::vector<Painter> painters_;
};

}  // namespace

RasterResults raster_atlas(const Engine& engine, Spill<Label>& charts, Spill<AtlasFace>& faces,
                           const SlotFrames& frames, const RasterPlan& plan, GroupSinks& sinks) {
  const std::uint64_t face_count = faces.size();
  StageLog::Stage stage(engine.log, "raster", 2 * face_count);
  const std::int64_t side = tile_size(engine, frames, plan);
  const Reservation regions_memory =
      engine.budget.reserve(AtlasRegions::memory_bytes(frames, side) +
                                frames.all().size() * sizeof(RegionBins::triangles[0]),
                            "the raster of so many textures");
  const AtlasRegions regions(frames, side);
  const std::uint64_t tiles_bytes = drawing_bytes(engine, frames, side);
  RegionBins bins =
      distribute_to_regions(engine, charts, faces, plan.keep_faces, regions, tiles_bytes, stage);

  RasterResults results;
  Spill<LevelPart> parts;
  {
    const Reservation tiles_memory = engine.budget.reserve(tiles_bytes, "tiles of texels");
    RegionsRaster raster(engine, frames, plan, regions, bins.triangles, face_count, stage);
    raster.draw(std::move(bins.buckets));
    results.work = raster.work();
    parts = raster.finish();
  }
  results.work.tile_size = side;
  results.levels = merge_parts(engine, std::move(parts), frames, sinks.of_worker(0));
  return results;
}

}  // namespace atlasgauge
