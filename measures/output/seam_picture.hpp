#pragma once

#include <string>

#include "io/ply_segments.hpp"
#include "measures/output/seam_file.hpp"

namespace atlasgauge {

/// All seam edges as segments in the colours of seam_color(), with D(e) as the value `discrepancy`
/// of their ends: -1 where there are no samples, as viewers cannot do with a NaN.
class SeamPicture : public SeamFile {
 public:
  /// Throws Error(kResource).
  SeamPicture(const std::string& path, const Engine& engine)
      : engine_(engine),
        memory_(engine.budget.reserve(engine.block_bytes(), "the colours of seam edges")),
        file_(path, "discrepancy") {}

  /// Keeps the colours in scratch from the ends of the segments to their edges.
  void write(SeamRows& rows) override;
  void commit() override { file_.commit(); }

 private:
  const Engine& engine_;
  const Reservation memory_;  ///< made early: who reads the rows may take all that is left
  PlySegments file_;
};

}  // namespace atlasgauge
