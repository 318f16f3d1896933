#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace atlasgauge {

/// Begins of the keys that the program does not measure yet. They are left out wherever a report is
/// compared with an oracle, an answer or a reference.
inline constexpr std::array<std::string_view, 3> kPendingKeys = {"seam_discrepancy", "worst_seams",
                                                                 "seam_edges_unsampled"};

/// Of a key, or of a line that begins with one.
inline bool is_pending(std::string_view key) {
  return std::any_of(kPendingKeys.begin(), kPendingKeys.end(),
                     [&](std::string_view begin) { return key.starts_with(begin); });
}

}  // namespace atlasgauge
