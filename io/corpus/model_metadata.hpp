#pragma once

#include <optional>
#include <string>

#include "io/warnings.hpp"

namespace atlasgauge {

/// The text of the metadata.json that describes a model: that of its folder, else the nearest above
/// it, up to the root of the corpus. One that is no JSON object is a warning, and as if it was not
/// there.
std::optional<std::string> metadata_of(const std::string& root, const std::string& model,
                                       Warnings& warnings);

}  // namespace atlasgauge
