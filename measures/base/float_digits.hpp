#pragma once

namespace atlasgauge {

/// The double nearest to the shortest decimal that names this float: 0.1f becomes 0.1, which prints
/// shorter than 0.10000000149011612 and reads as the same float. NaN stays NaN.
double double_of_digits(float value);

}  // namespace atlasgauge
