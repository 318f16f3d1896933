#pragma once

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <span>
#include <utility>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/mesh/triangle.hpp"
#include "stream/raster/atlas_regions.hpp"
#include "stream/raster/level_parts.hpp"
#include "stream/raster/tile_pyramid.hpp"

namespace atlasgauge {

/// The levels of slots that are drawn whole, for many workers at once, of which each has the levels
/// of one slot at a time.
///
/// When a worker goes on to another slot and has drawn all triangles of the one before, its texels
/// are counted. Where others have some of them, what it has drawn goes to scratch, to be put
/// together at the end. As workers come through the regions in their order, that happens a few
/// times a slot at most.
class WholeLevels {
 public:
  /// `triangles` of each slot.
  WholeLevels(const Engine& engine, const SlotFrames& frames, const AtlasRegions& regions,
              const std::vector<std::uint32_t>& triangles, LevelParts& parts);

  /// The tiles into which a worker is to draw triangles of a slot, until it asks for others.
  TilePyramid& tiles_of(std::size_t worker, SlotId slot);
  /// Says how many it drew.
  void add(std::size_t worker, std::uint64_t triangles) { workers_[worker].drawn += triangles; }

  /// When no worker is busy. Counts the rest.
  void finish();

  /// Pyramids that were counted.
  std::uint64_t counted() const;

 private:
  struct Worker {
    explicit Worker(LevelParts& all_parts) : parts(all_parts) {}
    SlotId slot = kNone<SlotId>;
    std::uint64_t drawn = 0;  ///< triangles of the slot
    TilePyramid tiles;
    LevelParts::Writer parts;
    std::uint64_t counted = 0;
  };
  /// What one worker has drawn of a slot.
  struct Piece {
    SlotId slot;
    Spill<CoveredTexel> texels;
  };

  void start(Worker& worker, SlotId slot) const;
  void leave(Worker& worker);
  void count(Worker& worker);
  void set_aside(const Worker& worker);
  void merge_last_slots();
  void join(Worker& worker, std::span<Piece> pieces);

  const Engine& engine_;
  const SlotFrames& frames_;
  const AtlasRegions& regions_;
  const std::vector<std::uint32_t>& triangles_;
  std::vector<Worker> workers_;
  std::mutex mutex_;  ///< of the pieces
  std::vector<Piece> pieces_;
};

}  // namespace atlasgauge
