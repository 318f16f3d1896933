#include "measures/texture_levels.hpp"

#include <memory>

#include "stream/engine/spill.hpp"

namespace atlasgauge {
namespace {

Json json_of(const TextureLevel& level) {
  const TexelCounts& counts = level.counts;
  return {{"rw", level.width},
          {"rh", level.height},
          {"totalTexels", counts.drawn},
          {"totalTexels_bilinear", counts.bilinear},
          {"overwrittenTexels", counts.overwritten},
          {"lostTexels", counts.lost},
          {"boundaryTexels", counts.boundary},
          {"texelClashes", counts.clashes}};
}

/// The 1 x 1 slot of a model without images and without a size given: nothing counts texels there.
Json unit_level() {
  Json level = json_of({});
  for (auto& [key, value] : level.items()) value = nullptr;
  level["rw"] = level["rh"] = 1;
  return Json::array({level});
}

/// Reads the levels of one slot after the other.
class LevelsBySlot {
 public:
  explicit LevelsBySlot(const Spill<TextureLevel>& levels) : reader_(levels) {
    more_ = reader_.read(level_);
  }

  Json next() {
    Json levels = Json::array();
    for (; more_ && raw(level_.slot) == slot_; more_ = reader_.read(level_)) {
      levels.push_back(json_of(level_));
    }
    ++slot_;
    return levels;
  }

 private:
  SpillReader<TextureLevel> reader_;
  TextureLevel level_{};
  bool more_ = false;
  std::uint32_t slot_ = 0;
};

}  // namespace

Report::Textures texture_levels(const MeshFacts& facts) {
  if (facts.textures.unit_slot) return [] { return unit_level; };
  return [&levels = facts.texture_levels] {
    return [rows = std::make_shared<LevelsBySlot>(levels)] { return rows->next(); };
  };
}

}  // namespace atlasgauge
