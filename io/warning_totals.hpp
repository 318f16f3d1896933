#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace atlasgauge {

/// Warnings by kind.
using WarningTotals = std::map<std::string, std::uint64_t>;

/// "warnings: 12 faces invalid, 1 library missing" and a line end; empty where there are
/// none.
std::string warnings_line(const WarningTotals& totals);

/// What the last such line of a text says; nothing where there is none.
WarningTotals read_warnings_line(std::string_view text);

}  // namespace atlasgauge
