#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

namespace atlasgauge {

/// Throws Error(kResource) where `more` elements beside `count` would be more than kMaxElements.
/// `what` is their plural.
void check_room(const std::string& path, const char* what, std::uint64_t count, std::uint64_t more);

}  // namespace atlasgauge
