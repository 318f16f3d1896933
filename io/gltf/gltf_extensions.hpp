#pragma once

#include <string>

namespace atlasgauge {

/// Whether a glTF that requires an extension can be measured: it is read here, or it changes
/// neither geometry, nor texture coordinates, nor the image of the base colour.
bool is_harmless_extension(const std::string& name);

}  // namespace atlasgauge
