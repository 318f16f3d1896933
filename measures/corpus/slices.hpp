#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace atlasgauge {

/// How many slices work of so many seconds is cut into: of about a minute each, so that starting a
/// task costs little beside its work; at most 1000, as batch systems often take no longer array,
/// and no more than there are models.
std::uint64_t usual_slices(std::span<const double> seconds);

/// The slice of each model, so that all take about as long: from the longest model on, each goes to
/// the slice that has least yet (Graham 1969: at most 4/3 of the best there is). Depends on nothing
/// but the numbers; of equals the first comes first.
std::vector<std::uint64_t> balanced_slices(std::span<const double> seconds, std::uint64_t slices);

}  // namespace atlasgauge
