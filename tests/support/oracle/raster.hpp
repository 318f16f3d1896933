#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "tests/support/oracle/levels.hpp"

// Texel by texel, triangle by triangle.
namespace atlasgauge::oracle {

// Of one slot at one mip level.
struct LevelCounts {
  Size size;
  int64_t total = 0;
  int64_t bilinear = 0;
  int64_t overwritten = 0;
  int64_t lost = 0;
  int64_t boundary = 0;
  int64_t clashes = 0;
  int64_t covered = 0;
  int64_t covered_again_by_the_same_chart = 0;
  int64_t covered_by_several_charts = 0;

  int64_t texels() const { return int64_t{size.first} * size.second; }
};

// From level 0 on; none for a slot without a size.
using SlotCounts = std::vector<LevelCounts>;

std::vector<SlotCounts> raster_slots(const Analysis& analysis);

// Sums over slots at level 0, in texels.
struct Coverage {
  int64_t covered = 0;
  int64_t of_covered_slots = 0;
  int64_t of_all_slots = 0;
};

// Nothing where the model counts no texels or covers none: then there is no occupancy.
std::optional<Coverage> coverage_of(const Analysis& analysis, const std::vector<SlotCounts>& slots);

void report_raster(nlohmann::json& report, const Analysis& analysis,
                   const std::vector<SlotCounts>& slots);

}  // namespace atlasgauge::oracle
