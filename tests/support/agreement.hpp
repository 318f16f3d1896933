#pragma once

#include <nlohmann/json.hpp>

namespace atlasgauge {

/// Values that divide rounded sums, or take singular values in double, agree to this.
inline constexpr double kRelative = 1e-11;
/// Conformality of a sliver, between 0 and 1, is what rounding left of its area.
inline constexpr double kConformality = 1e-14;
/// The deviation of values that are all but equal is the rounding of the values, against their rms.
inline constexpr double kDeviation = 1e-13;
/// Differences of colours of up to some 255, whose mixing rounds in an order of one's own.
inline constexpr double kDiscrepancy = 1e-11;

/// Whether two values of a report agree, all that they hold included. Numbers with a fraction may
/// differ relatively, or by the absolute tolerance.
bool agree(const nlohmann::json& got, const nlohmann::json& want, double absolute);

/// The same for lists of worst seams. Where rounding may have changed the order of discrepancies,
/// any order will do, and at the end of a full list any seam of such a discrepancy.
bool worst_seams_agree(const nlohmann::json& got, const nlohmann::json& want);

}  // namespace atlasgauge
