#pragma once

#include "io/ply_segments.hpp"

namespace atlasgauge {

/// The colour of a seam edge by its D(e), the same in every picture so that models compare: dark
/// blue at 0, cyan at 8, green at 16, yellow at 32, red from 64 on, linear in between. Grey for a
/// NaN.
Rgb seam_color(double discrepancy);

}  // namespace atlasgauge
