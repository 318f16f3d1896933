#include <algorithm>

#include "measures/base/measure.hpp"
#include "measures/texture_levels.hpp"

namespace atlasgauge {
namespace {

bool outside_unit_square(const TexCoord& t) {
  return t.u < 0 || t.u > 1 || t.v < 0 || t.v > 1;
}

/// The textures, and faces that do not meet them as they should.
struct TextureUse {
  static constexpr std::string_view name = "texture_use";

  std::uint64_t unmapped = 0;
  std::uint64_t uv_outside = 0;
  std::uint64_t without_slot = 0;
  std::uint64_t without_size = 0;
  std::uint64_t far = 0;

  void accumulate(const Triangle& triangle) {
    if (!triangle.at_raw_level()) return;
    const auto& t = triangle.t;
    if (!std::all_of(t, t + 3, [](const TexCoord& uv) { return is_finite(uv); })) ++unmapped;
    if (std::any_of(t, t + 3, outside_unit_square)) ++uv_outside;
    if (triangle.slot == kNone<SlotId>) {
      ++without_slot;
    } else if (!triangle.slot_has_size) {
      ++without_size;
    }
    if (triangle.at_welded_level() && triangle.uv_far) ++far;
  }

  void merge(const TextureUse& other) {
    unmapped += other.unmapped;
    uv_outside += other.uv_outside;
    without_slot += other.without_slot;
    without_size += other.without_size;
    far += other.far;
  }

  template <class Archive>
  void serialize(Archive& archive) {
    archive(unmapped, uv_outside, without_slot, without_size, far);
  }

  void finish(const MeshFacts& facts, Report& report) const {
    Json names = Json::array();
    for (const TextureSlot& slot : facts.textures.slots) {
      names.push_back(slot.name);
    }
    report.set_textures(facts.textures.slots.size(), texture_levels(facts));
    report.set("ntex", std::uint64_t{facts.textures.slots.size()});
    report.set("textures", std::move(names));
    report.set("faces_unmapped", unmapped);
    report.set("faces_untextured",
               facts.textures.has_images ? without_slot + without_size : std::uint64_t{0});
    report.set("faces_uv_outside", uv_outside);
    report.set("uv_far", far);
  }
};

const Registered<TextureUse> registered;

}  // namespace
}  // namespace atlasgauge
