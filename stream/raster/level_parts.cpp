#include "stream/raster/level_parts.hpp"

#include <utility>

#include "stream/engine/sort_spill.hpp"
#include "stream/raster/mip_levels.hpp"
#include "stream/raster/texel_counts.hpp"

namespace atlasgauge {

void count_tiles(SlotId slot, const TilePyramid& pyramid, LevelParts::Writer& parts) {
  for (const LevelTile& tile : pyramid.tiles()) {
    parts.push({slot, tile.level, count_texels(tile.tile)});
  }
}

Spill<TextureLevel> merge_parts(const Engine& engine, Spill<LevelPart> parts,
                                const SlotFrames& frames, GroupSink& sink) {
  parts = sort_spill(engine, std::move(parts),
                     [](const LevelPart& a, const LevelPart& b) { return a.key() < b.key(); });
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

}  // namespace atlasgauge
