#include "measures/texture_seams.hpp"

#include <cmath>

#include "stream/engine/spill.hpp"

namespace atlasgauge {

Json seam_discrepancy_by_texture(const MeshFacts& facts) {
  Json values = Json::array();
  SpillReader<TextureSeams> reader(facts.texture_seams);
  for (TextureSeams seams{}; reader.read(seams);) {
    while (values.size() < raw(seams.slot)) values.push_back(nullptr);
    values.push_back(std::isfinite(seams.discrepancy) ? Json(seams.discrepancy) : Json());
  }
  while (values.size() < facts.textures.slots.size()) values.push_back(nullptr);
  return values;
}

}  // namespace atlasgauge
