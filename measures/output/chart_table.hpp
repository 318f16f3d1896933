#pragma once

#include <string>

#include "io/table_file.hpp"
#include "stream/groups.hpp"

namespace atlasgauge {

/// The table of all charts, a row each, by number:
///
///   chart                       its number: its smallest face
///   texture                     N of `texture_N`; missing for faces without a texture
///   faces, folds                faces; those folded over (see `nfolds`)
///   null, orientable            1 or 0: UV area is 0; faces can be made to run coherently
///   area_3d                     model units squared
///   area_uv                     sum of the absolute areas of its faces, texels squared
///   perimeter                   of its uv boundary edges, texels
///   u_min, v_min, u_max, v_max  its box, as in the file; missing if no face has UVs
///   width, height               of that box, texels
///   thinnest_side               the shorter of the two
class ChartTable {
 public:
  /// Throws Error(kUsage) for a suffix that is no format, Error(kResource).
  explicit ChartTable(const std::string& path);

  void add(const Chart& chart);
  void commit() { file_.commit(); }

 private:
  TableFile file_;
};

}  // namespace atlasgauge
