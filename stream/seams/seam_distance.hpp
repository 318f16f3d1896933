#pragma once

#include <cstdint>
#include <limits>

#include "stream/engine/engine.hpp"
#include "stream/mesh/records.hpp"
#include "stream/seams/footprint_colours.hpp"
#include "stream/seams/seam_rule.hpp"
#include "stream/seams/texel_store.hpp"

namespace atlasgauge {

/// The mean distance of the colours on both sides, the distances added in order. `source(side)` has
/// the answers of a side.
template <class Sources>
double mean_distance(const SeamSamples& samples, const TexelKind (&kinds)[2], Sources source) {
  if (samples.count == 0) return std::numeric_limits<double>::quiet_NaN();
  FootprintColours a(source(0), samples.sides[0], kinds[0]);
  FootprintColours b(source(1), samples.sides[1], kinds[1]);
  double sum = 0;
  for (std::uint64_t i = 0; i < samples.count; ++i) sum += distance(a.at(i), b.at(i));
  return sum / static_cast<double>(samples.count);
}

}  // namespace atlasgauge
