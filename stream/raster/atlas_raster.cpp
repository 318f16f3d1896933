#include "stream/raster/atlas_raster.hpp"

#include <algorithm>
#include <cstddef>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "stream/engine/keyed_groups.hpp"
#include "stream/engine/sort_spill.hpp"
#include "stream/raster/bin_triangle.hpp"
#include "stream/raster/mip_levels.hpp"
#include "stream/raster/texel_counts.hpp"
#include "stream/raster/texel_tile.hpp"
#include "stream/raster/tile_grid.hpp"

namespace atlasgauge {
namespace {

std::int64_t largest_side(const SlotFrames& frames) {
  double side = 1;
  for (const SlotFrame& frame : frames.all()) side = std::max({side, frame.width, frame.height});
  return static_cast<std::int64_t>(side);
}

MipLevels levels_of(const SlotFrame& frame) {
  return {static_cast<std::uint64_t>(frame.width), static_cast<std::uint64_t>(frame.height)};
}

/// What was counted in one tile of a level.
struct LevelPart {
  SlotId slot;
  std::uint32_t level;
  TexelCounts counts;

  std::pair<std::uint32_t, std::uint32_t> key() const { return {raw(slot), level}; }
};

/// What one worker draws with.
class Painter {
 public:
  Painter(std::unique_ptr<Raster> raster, SharedSpill<LevelPart>& parts)
      : raster_(std::move(raster)), parts_(parts) {}

  /// Makes ready to draw the levels of a slot from `first` on, each in a tile of its own.
  void begin_pyramid(const MipLevels& levels, std::uint32_t first) {
    tiles_.resize(std::max<std::size_t>(tiles_.size(), levels.count() - first));
    for (std::uint32_t level = first; level < levels.count(); ++level) {
      const LevelSize size = levels.size(level);
      tiles_[level - first].reset({0, 0, size.width, size.height}, size);
    }
  }
  void draw_pyramid(std::span<const BinTriangle> triangles, const SlotFrame& frame,
                    const MipLevels& levels, std::uint32_t first) {
    for (std::uint32_t level = first; level < levels.count(); ++level) {
      draw(triangles, at_level(frame, levels.size(level)), tiles_[level - first]);
    }
  }
  void end_pyramid(SlotId slot, const MipLevels& levels, std::uint32_t first) {
    for (std::uint32_t level = first; level < levels.count(); ++level) {
      parts_.push({slot, level, count_texels(tiles_[level - first])});
    }
    if (first < levels.count()) ++tiles_done_;
  }

  void begin_tile(const TexelRect& rect, const LevelSize& level) {
    if (tiles_.empty()) tiles_.resize(1);
    tiles_[0].reset(rect, level);
  }
  void draw_tile(std::span<const BinTriangle> triangles, const SlotFrame& frame) {
    draw(triangles, frame, tiles_[0]);
  }
  void end_tile(SlotId slot, std::uint32_t level) {
    parts_.push({slot, level, count_texels(tiles_[0])});
    ++tiles_done_;
  }

  /// Adds what another drew into its first `tiles` tiles.
  void merge_tiles(const Painter& other, std::size_t tiles) {
    for (std::size_t i = 0; i < tiles; ++i) tiles_[i].merge(other.tiles_[i]);
  }

  void flush() { parts_.flush(); }
  std::uint64_t tiles_done() const { return tiles_done_; }
  const RasterTally& tally() const { return raster_->tally(); }

 private:
  void draw(std::span<const BinTriangle> triangles, const SlotFrame& frame, TexelTile& tile) {
    while (!triangles.empty()) {
      const auto batch = triangles.first(std::min(triangles.size(), raster_->batch_size()));
      snapped_.clear();
      for (const BinTriangle& triangle : batch) snapped_.push_back(snapped(triangle, frame));
      raster_->draw(snapped_, tile);
      triangles = triangles.subspan(batch.size());
    }
  }

  std::unique_ptr<Raster> raster_;
  SharedSpill<LevelPart>::Writer parts_;
  std::vector<SnappedTriangle> snapped_;
  std::vector<TexelTile> tiles_;
  std::uint64_t tiles_done_ = 0;
};

class AtlasRaster {
 public:
  AtlasRaster(const Engine& engine, const SlotFrames& frames, const RasterPlan& plan)
      : engine_(engine),
        frames_(frames),
        tile_size_(plan.tile_size > 0
                       ? plan.tile_size
                       : choose_tile_size(engine.budget.free_bytes(), engine.workers.count(),
                                          std::min(plan.largest_tile, largest_side(frames)))),
        memory_(engine.budget.reserve(tiles_bytes(), "tiles of texels")),
        parts_(engine.scratch) {
    for (std::size_t i = 0; i < engine.workers.count(); ++i) {
      painters_.emplace_back(plan.make(), parts_);
    }
  }

  void draw_slots(KeyedGroups<BinTriangle>::Buckets bins, StageLog::Stage& stage) {
    KeyedGroups<BinTriangle> slots(
        engine_,
        [&](std::size_t worker, std::span<BinTriangle> bin) { draw_small_bin(worker, bin); },
        [&](std::uint32_t slot, Spill<BinTriangle> bin) {
          draw_large_bin(SlotId{slot}, std::move(bin));
        });
    slots.process(std::move(bins), &stage);
    std::sort(large_slots_.begin(), large_slots_.end(),
              [](const auto& a, const auto& b) { return raw(a.first) < raw(b.first); });
    for (auto& [slot, bin] : large_slots_) draw_large_bin(slot, std::move(bin));
  }

  RasterWork work() const {
    RasterWork work;
    work.tile_size = tile_size_;
    for (const Painter& painter : painters_) {
      work.tiles += painter.tiles_done();
      work.triangles.merge(painter.tally());
    }
    return work;
  }

  /// By slot and level.
  Spill<LevelPart> finish() {
    for (Painter& painter : painters_) painter.flush();
    memory_.release();
    return sort_spill(engine_, parts_.finish(),
                      [](const LevelPart& a, const LevelPart& b) { return a.key() < b.key(); });
  }

 private:
  std::uint64_t tiles_bytes() const {
    const std::int64_t side = std::min(tile_size_, largest_side(frames_));
    return engine_.workers.count() * (pyramid_bytes(side) + engine_.block_bytes()) +
           engine_.block_bytes();
  }

  /// A bin in memory: of a slot that fits one tile it is drawn at once, else set aside.
  void draw_small_bin(std::size_t worker, std::span<const BinTriangle> bin) {
    const SlotId slot{bin[0].bin};
    const SlotFrame& frame = frames_.of(slot);
    const MipLevels levels = levels_of(frame);
    if (levels.first_within(tile_size_) > 0) return set_aside(slot, bin);
    Painter& painter = painters_[worker];
    painter.begin_pyramid(levels, 0);
    painter.draw_pyramid(bin, frame, levels, 0);
    painter.end_pyramid(slot, levels, 0);
  }

  void set_aside(SlotId slot, std::span<const BinTriangle> bin) {
    SpillWriter<BinTriangle> writer(engine_.scratch);
    writer.append(bin);
    const std::lock_guard lock(large_slots_mutex_);
    large_slots_.emplace_back(slot, writer.finish());
  }

  /// Calls use(worker, triangles) for all of a spill, on all workers at once. Consumes it.
  template <class Use>
  void visit(Spill<BinTriangle> triangles, Use use) {
    std::vector<BlockBuffer> buffers(engine_.workers.count());
    engine_.workers.for_each(triangles.block_count(), [&](std::size_t worker, std::size_t block) {
      use(worker, triangles.load(block, buffers[worker]));
      triangles.free_block(block);
    });
  }

  void draw_large_bin(SlotId slot, Spill<BinTriangle> bin) {
    const SlotFrame& frame = frames_.of(slot);
    const MipLevels levels = levels_of(frame);
    const TileGrid grid(levels, tile_size_);
    const std::uint32_t first = grid.tiled_levels();
    for (Painter& painter : painters_) painter.begin_pyramid(levels, first);
    KeyedGroups<BinTriangle>::Buckets tiles =
        draw_and_distribute(std::move(bin), frame, levels, grid);
    merge_into_first(levels.count() - first);
    painters_[0].end_pyramid(slot, levels, first);
    draw_tiles(slot, std::move(tiles), frame, levels, grid);
  }

  void merge_into_first(std::size_t tiles) {
    for (std::size_t i = 1; i < painters_.size(); ++i) {
      painters_[0].merge_tiles(painters_[i], tiles);
    }
  }

  /// Draws the levels that fit one tile, and distributes to the tiles of the others.
  KeyedGroups<BinTriangle>::Buckets draw_and_distribute(Spill<BinTriangle> bin,
                                                        const SlotFrame& frame,
                                                        const MipLevels& levels,
                                                        const TileGrid& grid) {
    const std::size_t workers = engine_.workers.count();
    const std::uint64_t free_bytes = engine_.budget.free_bytes();
    const KeyRanges ranges = KeyedGroups<BinTriangle>::plan(
        engine_, bin.size() * grid.tiled_levels(), 0, grid.tile_count(), free_bytes / 8 * 7,
        free_bytes / 2, KeyedGroups<BinTriangle>::even_buckets(engine_));
    const Reservation memory = engine_.budget.reserve(
        Partition<BinTriangle>::memory_bytes(ranges.bucket_count(), workers, engine_.block_bytes()),
        "distributing triangles to tiles");
    Partition<BinTriangle> partition(engine_.scratch, ranges.bucket_count());
    std::vector<Partition<BinTriangle>::Writer> writers(workers,
                                                        Partition<BinTriangle>::Writer(partition));
    const std::vector<SlotFrame> level_frames = at_levels(frame, levels.sizes(grid.tiled_levels()));
    visit(std::move(bin), [&](std::size_t worker, std::span<const BinTriangle> triangles) {
      painters_[worker].draw_pyramid(triangles, frame, levels, grid.tiled_levels());
      for (BinTriangle triangle : triangles) {
        visit_touched(triangle, level_frames, grid, [&](std::uint32_t tile) {
          triangle.bin = tile;
          writers[worker].push(ranges.bucket_of(tile), triangle);
        });
      }
    });
    for (auto& writer : writers) writer.flush();
    return {ranges, partition.finish()};
  }

  void draw_tiles(SlotId slot, KeyedGroups<BinTriangle>::Buckets tiles, const SlotFrame& frame,
                  const MipLevels& levels, const TileGrid& grid) {
    const auto begin = [&](Painter& painter, std::uint32_t tile) {
      painter.begin_tile(grid.rect_of(tile), levels.size(grid.level_of(tile)));
    };
    const auto frame_of = [&](std::uint32_t tile) {
      return at_level(frame, levels.size(grid.level_of(tile)));
    };
    KeyedGroups<BinTriangle> groups(
        engine_,
        [&](std::size_t worker, std::span<BinTriangle> triangles) {
          const std::uint32_t tile = triangles[0].bin;
          Painter& painter = painters_[worker];
          begin(painter, tile);
          painter.draw_tile(triangles, frame_of(tile));
          painter.end_tile(slot, grid.level_of(tile));
        },
        [&](std::uint32_t tile, Spill<BinTriangle> triangles) {
          for (Painter& painter : painters_) begin(painter, tile);
          visit(std::move(triangles), [&](std::size_t worker, std::span<const BinTriangle> some) {
            painters_[worker].draw_tile(some, frame_of(tile));
          });
          merge_into_first(1);
          painters_[0].end_tile(slot, grid.level_of(tile));
        });
    groups.process(std::move(tiles));
  }

  const Engine& engine_;
  const SlotFrames& frames_;
  std::int64_t tile_size_;
  Reservation memory_;
  SharedSpill<LevelPart> parts_;
  std::vector<Painter> painters_;
  std::mutex large_slots_mutex_;
  std::vector<std::pair<SlotId, Spill<BinTriangle>>> large_slots_;
};

KeyedGroups<BinTriangle>::Buckets distribute_to_slots(const Engine& engine, Spill<Label>& charts,
                                                      Spill<AtlasFace>& faces,
                                                      const SlotFrames& frames, bool keep_faces) {
  using Mode = SpillReader<AtlasFace>::Mode;
  const auto push_faces = [&](auto push) {
    SpillReader<Label> chart_reader(charts);
    SpillReader<AtlasFace> face_reader(faces, keep_faces ? Mode::kKeep : Mode::kConsume);
    AtlasFace face;
    Label chart;
    while (face_reader.read(face) && chart_reader.read(chart)) {
      if (!face.is_drawn()) continue;
      push(0, {raw(face.slot()), chart.first(), {face.uv(0), face.uv(1), face.uv(2)}});
    }
  };
  return KeyedGroups<BinTriangle>::distribute(engine, faces.size(), frames.all().size(),
                                              "distributing triangles to textures", push_faces,
                                              KeyedGroups<BinTriangle>::even_buckets(engine));
}

/// Adds up the parts of every level; a level that no triangle touched has none.
Spill<TextureLevel> merge_parts(const Engine& engine, Spill<LevelPart> parts,
                                const SlotFrames& frames, GroupSink& sink) {
  GroupBuffer<TextureLevel> output(sink);
  SpillWriter<TextureLevel> all(engine.scratch);
  SpillReader<LevelPart> reader(parts, SpillReader<LevelPart>::Mode::kConsume);
  LevelPart part{};
  bool more = reader.read(part);
  for (std::uint32_t slot = 0; slot < frames.all().size(); ++slot) {
    const SlotFrame& frame = frames.of(SlotId{slot});
    if (!frame.has_size) continue;
    const MipLevels levels = levels_of(frame);
    for (std::uint32_t level = 0; level < levels.count(); ++level) {
      const LevelSize size = levels.size(level);
      TextureLevel whole{SlotId{slot},
                         level,
                         static_cast<std::uint64_t>(size.width),
                         static_cast<std::uint64_t>(size.height),
                         {}};
      for (; more && part.key() == std::pair(slot, level); more = reader.read(part)) {
        whole.counts.merge(part.counts);
      }
      output.push(whole);
      all.push(whole);
    }
  }
  output.flush();
  return all.finish();
}

}  // namespace

RasterResults raster_atlas(const Engine& engine, Spill<Label>& charts, Spill<AtlasFace>& faces,
                           const SlotFrames& frames, const RasterPlan& plan, GroupSinks& sinks) {
  StageLog::Stage stage(engine.log, "raster", frames.all().size());
  KeyedGroups<BinTriangle>::Buckets bins =
      distribute_to_slots(engine, charts, faces, frames, plan.keep_faces);
  AtlasRaster raster(engine, frames, plan);
  raster.draw_slots(std::move(bins), stage);
  RasterResults results;
  results.work = raster.work();
  results.levels = merge_parts(engine, raster.finish(), frames, sinks.of_worker(0));
  return results;
}

}  // namespace atlasgauge
