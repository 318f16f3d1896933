#pragma once

#include <string>

#include "io/texture/texture_slots.hpp"
#include "stream/engine/engine.hpp"
#include "stream/engine/labels.hpp"
#include "stream/mesh/records.hpp"

namespace atlasgauge {

/// What maps are drawn from; all but the frames in face order.
struct AtlasStore {
  Spill<Label> charts;
  Spill<AtlasFace> faces;
  Spill<double> areas_3d;    ///< model units squared
  Spill<float> distortions;  ///< quasi-conformal; 0 where a face has none
  SlotFrames frames;
};

/// Draws a map of every slot with a size into a folder, and a picture of it: `0003_name.exr` and
/// `0003_name.png` for slot 3. Consumes the store.
///
/// The map is a tiled OpenEXR image with all its mip levels, each drawn for itself, in bounded
/// memory whatever its size. Channels: `n`, the number of triangles on a texel; `chart`, the number
/// of its chart plus one; `s_f` in units of `scaling_unit` texels squared per model unit squared;
/// `qcd`; and `sign` of the UV area. All are 0 where nothing covers the texel.
void write_maps(const Engine& engine, AtlasStore atlas, const TextureSlots& textures,
                double scaling_unit, const std::string& folder);

}  // namespace atlasgauge
