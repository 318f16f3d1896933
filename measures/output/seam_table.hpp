#pragma once

#include <string>

#include "io/table_file.hpp"
#include "measures/output/seam_file.hpp"

namespace atlasgauge {

/// The table of all seam edges, a row each, in the order of their vertices:
///
///   x0, y0, z0, x1, y1, z1  its ends, model units
///   length_3d               model units
///   texture_a               N of `texture_N` on one side; missing for faces without a texture
///   u0_a, v0_a, u1_a, v1_a  the UVs there at the two ends, as in the file; missing without UVs
///   texture_b, u0_b, ...    the same of the other side
///   samples                 n of D(e); 0 if the edge is too short, missing if it cannot be sampled
///   discrepancy             D(e), 0 to 441; missing without samples
///   texmetro_discrepancy    what TexMetro has for it; only if it was asked for
///
/// UVs have the shortest digits that give the same floats back.
class SeamTable : public SeamFile {
 public:
  /// Throws Error(kUsage) for a suffix that is no format, Error(kResource).
  SeamTable(const std::string& path, bool texmetro);

  void write(SeamRows& rows) override;
  void commit() override { file_.commit(); }

 private:
  void add(const LocatedSeam& seam);

  const bool texmetro_;
  TableFile file_;
};

}  // namespace atlasgauge
