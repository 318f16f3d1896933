#pragma once

#include "io/json/json_view.hpp"
#include "io/model/affine.hpp"

namespace atlasgauge {

/// A matrix of 16 numbers, column after column, as glTF and 3D Tiles have it. Throws Error(kInput)
/// for one that is not affine.
Affine affine_from(const JsonView& matrix);

}  // namespace atlasgauge
