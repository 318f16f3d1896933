#pragma once

#include "tests/support/oracle/levels.hpp"

// Colours between the texels of an image.
namespace atlasgauge::oracle {

// Texel coordinates with v up; centres lie at half-integers; the image repeats in both directions.
Colour bilinear(const Slot& slot, const Texel& point);

double colour_distance(const Colour& a, const Colour& b);

}  // namespace atlasgauge::oracle
