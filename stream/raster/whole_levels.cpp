#include "stream/raster/whole_levels.hpp"

#include <algorithm>
#include <utility>

#include "stream/raster/mip_levels.hpp"

namespace atlasgauge {

WholeLevels::WholeLevels(const Engine& engine, const SlotFrames& frames,
                         const AtlasRegions& regions, const std::vector<std::uint32_t>& triangles,
                         LevelParts& parts)
    : engine_(engine), frames_(frames), regions_(regions), triangles_(triangles) {
  for (std::size_t i = 0; i < engine.workers.count(); ++i) workers_.emplace_back(parts);
}

TilePyramid& WholeLevels::tiles_of(std::size_t worker, SlotId slot) {
  Worker& own = workers_[worker];
  if (own.slot != slot) {
    leave(own);
    start(own, slot);
  }
  return own.tiles;
}

void WholeLevels::start(Worker& worker, SlotId slot) const {
  worker.slot = slot;
  worker.drawn = 0;
  worker.tiles.clear();
  const MipLevels levels = levels_of(frames_.of(slot));
  const auto [first, end] = regions_.whole_levels(slot);
  for (std::uint32_t level = first; level < end; ++level) {
    const LevelSize size = levels.size(level);
    worker.tiles.add(level, size, {0, 0, size.width, size.height});
  }
}

void WholeLevels::leave(Worker& worker) {
  if (worker.drawn == 0 || worker.tiles.empty()) return;
  worker.drawn == triangles_[raw(worker.slot)] ? count(worker) : set_aside(worker);
}

void WholeLevels::count(Worker& worker) {
  count_tiles(worker.slot, worker.tiles, worker.parts);
  ++worker.counted;
}

void WholeLevels::set_aside(const Worker& worker) {
  SpillWriter<CoveredTexel> writer(engine_.scratch);
  worker.tiles.visit_covered([&](const CoveredTexel& texel) { writer.push(texel); });
  Piece piece{worker.slot, writer.finish()};
  const std::lock_guard lock(mutex_);
  pieces_.push_back(std::move(piece));
}

/// Of workers that drew the same slot last, the first gets what all have drawn.
void WholeLevels::merge_last_slots() {
  for (std::size_t i = 0; i < workers_.size(); ++i) {
    for (std::size_t k = i + 1; k < workers_.size(); ++k) {
      Worker &to = workers_[i], &from = workers_[k];
      if (to.slot != from.slot || to.drawn == 0 || from.drawn == 0) continue;
      to.tiles.merge(from.tiles);
      to.drawn += std::exchange(from.drawn, 0);
    }
  }
}

void WholeLevels::finish() {
  merge_last_slots();
  for (Worker& worker : workers_) leave(worker);
  std::sort(pieces_.begin(), pieces_.end(),
            [](const Piece& a, const Piece& b) { return raw(a.slot) < raw(b.slot); });
  std::vector<std::span<Piece>> slots;
  for (std::size_t begin = 0, end = 0; begin < pieces_.size(); begin = end) {
    while (end < pieces_.size() && pieces_[end].slot == pieces_[begin].slot) ++end;
    slots.push_back(std::span(pieces_).subspan(begin, end - begin));
  }
  engine_.workers.for_each(
      slots.size(), [&](std::size_t worker, std::size_t i) { join(workers_[worker], slots[i]); });
  for (Worker& worker : workers_) worker.parts.flush();
}

void WholeLevels::join(Worker& worker, std::span<Piece> pieces) {
  start(worker, pieces[0].slot);
  for (Piece& piece : pieces) {
    SpillReader<CoveredTexel> reader(piece.texels, SpillReader<CoveredTexel>::Mode::kConsume);
    for (auto block = reader.next_block(); !block.empty(); block = reader.next_block()) {
      for (const CoveredTexel& texel : block) worker.tiles.cover(texel);
    }
  }
  count(worker);
}

std::uint64_t WholeLevels::counted() const {
  std::uint64_t counted = 0;
  for (const Worker& worker : workers_) counted += worker.counted;
  return counted;
}

}  // namespace atlasgauge
