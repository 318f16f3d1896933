#pragma once

#include <cstddef>
#include <cstdint>

#include "stream/engine/engine.hpp"
#include "stream/engine/spill.hpp"
#include "stream/groups.hpp"

namespace atlasgauge {

/// A seam edge with samples, on one of its slots.
struct TextureSample {
  SlotId slot;
  std::uint32_t padding;
  double length_3d;
  double discrepancy;
};

/// The mean discrepancy of each slot, weighted by length. Sums are made of integers, in units of
/// 2^-62 of the largest term of their slot, so that they do not depend on the order of the samples.
Spill<TextureSeams> sum_by_texture(const Engine& engine, Spill<TextureSample> samples,
                                   std::size_t slots);

}  // namespace atlasgauge
