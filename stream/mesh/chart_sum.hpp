#pragma once

#include <cstdint>

#include "stream/engine/pair_sum.hpp"
#include "stream/groups.hpp"
#include "stream/mesh/chart_part.hpp"

namespace atlasgauge {

/// Adds up the parts of one chart, exactly, so that neither their order nor how its faces were cut
/// into parts matters.
class ChartSum {
 public:
  void add(const ChartPart& part);
  Chart finish(FaceId number, const SlotFrames& frames) const;

 private:
  /// Faces of nonzero UV area by sign.
  struct Signs {
    QuickSum total;
    std::uint64_t positive = 0, negative = 0;

    void add(double area, bool is_positive, std::uint32_t faces) {
      total.add(area);
      (is_positive ? positive : negative) += faces;
    }
    std::uint64_t folds(double absolute) const;
  };

  std::uint64_t faces_ = 0;
  SlotId slot_ = kNone<SlotId>;
  bool conflict_ = false;
  UvBox box_;
  QuickSum area_3d_, perimeter_, absolute_;
  Signs as_is_, coherent_;
};

}  // namespace atlasgauge
