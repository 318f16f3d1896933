#pragma once

#include <vector>

#include "bench/worst_cases.hpp"

namespace atlasgauge {

std::vector<WorstCase> star_cases();       ///< huge vertices and edges
std::vector<WorstCase> strip_cases();      ///< long components and many charts
std::vector<WorstCase> collapse_cases();   ///< models of which nothing is left at some level
std::vector<WorstCase> duplicate_cases();  ///< faces that come twice
std::vector<WorstCase> material_cases();   ///< many materials
std::vector<WorstCase> long_line_cases();  ///< one line as long as the file
std::vector<WorstCase> number_cases();     ///< numbers beyond any type
std::vector<WorstCase> atlas_cases();      ///< UVs that are hard to raster
std::vector<WorstCase> site_cases();       ///< scans in random order

}  // namespace atlasgauge
