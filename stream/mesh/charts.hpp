#pragma once

#include <cstdint>

#include "stream/engine/engine.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/components.hpp"
#include "stream/mesh/records.hpp"

namespace atlasgauge {

/// Hands out the charts. `labels` are those of the uv level; `largest_area_uv` bounds |area_uv| of
/// the faces. Returns the faces of null charts, in no order.
Spill<FaceId> group_charts(const Engine& engine, FaceLabels& labels, Spill<FaceFacts>& facts,
                           double largest_area_uv, GroupSinks& sinks);

}  // namespace atlasgauge
