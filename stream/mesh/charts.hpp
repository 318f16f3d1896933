#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "stream/engine/engine.hpp"
#include "stream/engine/quantiles.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/components.hpp"
#include "stream/mesh/records.hpp"

namespace atlasgauge {

/// What charts are made of; all but the borders in face order.
struct ChartParts {
  FaceLabels& labels;  ///< of the uv level
  Spill<AtlasFace>& faces;
  Spill<double>& areas_3d;    ///< empty where nobody asks for the charts'
  Spill<BorderEdge> borders;  ///< empty where nobody asks for perimeters
};

struct ChartResults {
  Spill<FaceId> null_faces;  ///< the faces of null charts, in no order
  Spill<Chart> charts;       ///< by number; empty unless they were to be kept
};

/// Hands out the charts, to the sinks and as samples to the stores, one a distribution.
ChartResults group_charts(const Engine& engine, ChartParts parts, const SlotFrames& frames,
                          bool keep, GroupSinks& sinks,
                          std::vector<std::unique_ptr<SampleStore>>& samples);

}  // namespace atlasgauge
