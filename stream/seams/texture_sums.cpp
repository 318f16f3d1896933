#include "stream/seams/texture_sums.hpp"

#include <algorithm>
#include <vector>

#include "stream/engine/fixed_sum.hpp"

namespace atlasgauge {
namespace {

/// What is known of a slot's samples.
struct SlotSums {
  std::uint64_t edges = 0;
  FixedSum lengths, discrepancies;
};

template <class Use>
void visit(const Spill<TextureSample>& samples, Use use) {
  SpillReader<TextureSample> reader(samples);
  for (auto some = reader.next_block(); !some.empty(); some = reader.next_block()) {
    for (const TextureSample& sample : some) use(sample);
  }
}

}  // namespace

Spill<TextureSeams> sum_by_texture(const Engine& engine, Spill<TextureSample> samples,
                                   std::size_t slots) {
  const Reservation memory = engine.budget.reserve(
      slots * sizeof(SlotSums) + 2 * engine.block_bytes(), "seams of so many textures");
  std::vector<SlotSums> sums(slots);
  visit(samples, [&](const TextureSample& sample) {
    SlotSums& slot = sums[raw(sample.slot)];
    ++slot.edges;
    slot.lengths.expect(sample.length_3d);
    slot.discrepancies.expect(sample.length_3d * sample.discrepancy);
  });
  visit(samples, [&](const TextureSample& sample) {
    SlotSums& slot = sums[raw(sample.slot)];
    slot.lengths.add(sample.length_3d);
    slot.discrepancies.add(sample.length_3d * sample.discrepancy);
  });
  SpillWriter<TextureSeams> by_slot(engine.scratch);
  for (std::uint32_t slot = 0; slot < slots; ++slot) {
    const SlotSums& sum = sums[slot];
    if (sum.edges == 0) continue;
    const double length_3d = sum.lengths.value();
    by_slot.push({SlotId{slot}, sum.edges, length_3d, sum.discrepancies.value() / length_3d});
  }
  return by_slot.finish();
}

}  // namespace atlasgauge
